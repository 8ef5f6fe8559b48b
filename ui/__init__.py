"""What the user sees: panels, lists, menus and drawings over the viewports."""

from typing import Any

import bpy

from ..operators.bridge.registering import register_class
from . import menus, part_drawing, sight_drawing
from .chart import WCD_PT_chart
from .edit_panel import WCD_PT_edit
from .hulls_panel import WCD_PT_hulls
from .menus import (
    WCD_MT_edit,
    WCD_MT_hulls,
    WCD_MT_parts,
    WCD_MT_pick,
    WCD_MT_use,
    WCD_MT_view,
)
from .panels import WCD_PT_advanced, WCD_PT_main, WCD_PT_parts
from .parts_table import WCD_UL_parts
from .use_panel import WCD_PT_use, WCD_PT_why

CLASSES = (
    WCD_PT_main,
    WCD_UL_parts,
    WCD_PT_parts,
    WCD_PT_edit,
    WCD_PT_chart,
    WCD_PT_use,
    WCD_PT_why,
    WCD_PT_hulls,
    WCD_PT_advanced,
    WCD_MT_edit,
    WCD_MT_view,
    WCD_MT_use,
    WCD_MT_hulls,
    WCD_MT_parts,
    WCD_MT_pick,
)
# What is drawn over each viewport, and when Blender asks for it.
_DRAWINGS = (
    (sight_drawing.draw, "POST_VIEW"),
    (part_drawing.draw, "POST_VIEW"),
    (part_drawing.draw_name, "POST_PIXEL"),
)
# What takes the drawings off the viewports again.
_handlers: list[Any] = []


def is_registered() -> bool:
    """Return whether Blender knows the classes; the operators come before them."""
    last: bool = CLASSES[-1].is_registered
    return last


def register() -> None:
    """Register the classes, the submenu and the drawings; operators come before."""
    for cls in CLASSES:
        register_class(cls)
    menus.register()
    for draw, when in _DRAWINGS:
        add = bpy.types.SpaceView3D.draw_handler_add
        _handlers.append(add(draw, (), "WINDOW", when))


def unregister() -> None:
    """Undo `register`."""
    while _handlers:
        bpy.types.SpaceView3D.draw_handler_remove(_handlers.pop(), "WINDOW")
    part_drawing.stop()
    sight_drawing.stop()
    menus.unregister()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
