"""What the user sees: panels, lists, menus and drawings over the viewports."""

import bpy

from ..operators.bridge.untranslated import register_class
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


def is_registered() -> bool:
    """Return whether Blender knows the classes; the operators come before them."""
    last: bool = CLASSES[-1].is_registered
    return last


def register() -> None:
    """Register the classes, the submenu and the drawing; operators come before."""
    for cls in CLASSES:
        register_class(cls)
    menus.register()
    sight_drawing.register()
    part_drawing.register()


def unregister() -> None:
    """Undo `register`."""
    part_drawing.unregister()
    sight_drawing.unregister()
    menus.unregister()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
