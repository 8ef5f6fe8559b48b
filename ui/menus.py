"""The submenu Convex Parts of the menus Object and, in Edit Mode, Mesh."""

from __future__ import annotations

import bpy

from ..operators.settings import HULLS, MEASURE, RUN, SELECTION, hand_over
from .sidebar import draw_choices

# Operators in the order of the menu, each with the settings that it takes from the
# scene, or with the property that its submenu offers. None is a line between groups.
_ENTRIES = (
    ("wcd.decompose", RUN),
    ("wcd.measure", MEASURE),
    ("wcd.measure_selection", SELECTION),
    None,
    ("wcd.rename_parts", ()),
    ("wcd.separate", "original"),
    ("wcd.explode", ()),
    ("wcd.implode", ()),
    ("wcd.face_sets", ()),
    ("wcd.color_attribute", ()),
    ("wcd.build_hulls", HULLS),
    ("wcd.make_rigid", "kind"),
    None,
    ("wcd.show_sight", SELECTION),
    ("wcd.hide_sight", ()),
    ("wcd.show_picture", "picture"),
    None,
    ("wcd.clear", ()),
)

# The menus of Blender that get the submenu at their end.
_HOMES = ("VIEW3D_MT_object", "VIEW3D_MT_edit_mesh")


class WCD_MT_parts(bpy.types.Menu):
    """All operators on convex parts."""

    bl_label = "Convex Parts"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the menu."""
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        for entry in _ENTRIES:
            if entry is None:
                layout.separator()
            elif isinstance(entry[1], str):
                draw_choices(layout, *entry)
            else:
                button = layout.operator(entry[0])
                hand_over(context.scene.wcd, button, entry[1])


def _draw_submenu(menu: bpy.types.Menu, context: bpy.types.Context) -> None:
    """Add the submenu to one of Blender's menus."""
    menu.layout.separator()
    menu.layout.menu("WCD_MT_parts")


def register() -> None:
    """Add the submenu."""
    for name in _HOMES:
        getattr(bpy.types, name).append(_draw_submenu)


def unregister() -> None:
    """Undo `register`."""
    for name in _HOMES:
        getattr(bpy.types, name).remove(_draw_submenu)
