"""What the user sees: the settings and the panels."""

import bpy

from ..operators.settings import WCD_PG_settings
from . import menus
from .chart import WCD_PT_chart
from .hulls_panel import WCD_PT_hulls
from .menus import WCD_MT_parts
from .panels import WCD_PT_advanced, WCD_PT_main, WCD_PT_parts
from .parts_table import WCD_PT_edit, WCD_UL_parts
from .use_panel import WCD_PT_use, WCD_PT_why

CLASSES = (
    WCD_PG_settings,
    WCD_PT_main,
    WCD_UL_parts,
    WCD_PT_parts,
    WCD_PT_edit,
    WCD_PT_chart,
    WCD_PT_use,
    WCD_PT_why,
    WCD_PT_hulls,
    WCD_PT_advanced,
    WCD_MT_parts,
)


def register() -> None:
    """Register the classes and the settings of scenes."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.wcd = bpy.props.PointerProperty(type=WCD_PG_settings)
    menus.register()


def unregister() -> None:
    """Undo `register`."""
    menus.unregister()
    del bpy.types.Scene.wcd
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
