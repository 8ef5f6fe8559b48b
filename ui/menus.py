"""The submenu Convex Parts of the menus Object and, in Edit Mode, Mesh."""

from __future__ import annotations

import bpy

from ..operators.bridge.views.isolating import isolating
from ..operators.settings import HULL_RUN, MEASURE, RUN, SELECTION, hand_over
from .sidebar import draw_choices

# Operators in the order of the menu, each with the settings that it takes from the
# scene, or with the property that its submenu offers. None is a line between groups.
_ENTRIES = (
    ("wcd.decompose", RUN),
    ("wcd.measure", MEASURE),
    ("wcd.measure_selection", SELECTION),
    None,
    ("wcd.separate", "original"),
    ("wcd.explode", ()),
    ("wcd.implode", ()),
    ("wcd.face_sets", ()),
    ("wcd.color_attribute", ()),
    ("wcd.build_hulls", HULL_RUN),
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


class WCD_MT_pick(bpy.types.Menu):
    """What can be done with the parts that are picked in the viewport."""

    bl_label = "Convex Part"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the pie: left, right, bottom, top, then the corners from upper left."""
        pie = self.layout.menu_pie()
        obj = context.active_object
        rows = obj.wcd_parts if obj is not None else ()
        several = sum(row.chosen for row in rows) > 1
        merge = "wcd.merge_parts" if several else "wcd.merge_next"
        pie.operator(
            merge, text="Merge" if several else "Merge with…", icon="FULLSCREEN_EXIT"
        )
        split = pie.operator("wcd.split_parts", text="Split in Two", icon="MOD_EXPLODE")
        split.parts = 2
        pie.operator("wcd.assign_faces", text="Assign Faces", icon="FACESEL")
        isolated = obj is not None and isolating(obj) is not None
        text, icon = ("Show All", "HIDE_OFF") if isolated else ("Isolate", "HIDE_ON")
        pie.operator("wcd.isolate_parts", text=text, icon=icon).hide = not isolated
        pie.operator("wcd.rename_part", text="Rename", icon="GREASEPENCIL")
        pie.operator("wcd.lock_parts", text="Lock", icon="LOCKED")
        pie.operator("wcd.frame_parts", text="Frame", icon="ZOOM_SELECTED")
        pie.operator(
            "wcd.select_parts", text="Select Faces", icon="RESTRICT_SELECT_OFF"
        )


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
