"""The submenu Convex Parts of the menus Object and, in Edit Mode, Mesh; the pie."""

from __future__ import annotations

from typing import Any, TypeAlias

import bpy

from ..operators.bridge.views.isolating import isolating
from .sidebar import draw_choices

# How an operator is drawn: with the property that its submenu offers, or with a text
# and the values of properties.
_How: TypeAlias = str | dict[str, Any]
# What a menu holds, in its order: operators; names of submenus; and None for a line
# between groups.
_Entries: TypeAlias = tuple[tuple[str, _How] | str | None, ...]

# The menus of Blender that get the submenu at their end.
_HOMES = ("VIEW3D_MT_object", "VIEW3D_MT_edit_mesh")


class _Entered:
    """Half a menu that draws its entries; F3 finds them."""

    layout: Any
    _entries: _Entries

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the menu."""
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        for entry in self._entries:
            if entry is None:
                layout.separator()
            elif isinstance(entry, str):
                layout.menu(entry)
            else:
                _draw_entry(layout, *entry)


class WCD_MT_parts(_Entered, bpy.types.Menu):
    """All operators on convex parts."""

    bl_label = "Convex Parts"
    _entries = (
        ("wcd.decompose", {}),
        ("wcd.measure", {}),
        ("wcd.measure_selection", {}),
        None,
        "WCD_MT_edit",
        "WCD_MT_view",
        "WCD_MT_use",
        "WCD_MT_hulls",
        None,
        ("wcd.show_sight", {}),
        ("wcd.hide_sight", {}),
        ("wcd.show_picture", "picture"),
        None,
        ("wcd.clear", {}),
    )


class WCD_MT_edit(_Entered, bpy.types.Menu):
    """The operators that change parts by hand."""

    bl_label = "Edit Parts"
    _entries = (
        ("wcd.merge_parts", {}),
        ("wcd.split_parts", {"text": "Split Convex Parts in Two", "parts": 2}),
        ("wcd.split_parts", {"text": "Split Convex Parts by ψ", "parts": 0}),
        ("wcd.assign_faces", {}),
        ("wcd.smooth_seams", {}),
        ("wcd.mirror_parts", "direction"),
        None,
        ("wcd.rename_part", {}),
        ("wcd.rename_parts", {"text": "Rename All Convex Parts"}),
        ("wcd.lock_parts", {}),
        None,
        ("wcd.refresh_parts", {}),
    )


class WCD_MT_view(_Entered, bpy.types.Menu):
    """The operators that select and show parts, and mark their seams."""

    bl_label = "Pick, Select and View"
    _entries = (
        ("wcd.pick_parts", {}),
        ("wcd.select_parts", {}),
        ("wcd.select_boundary", {}),
        ("wcd.frame_parts", {}),
        None,
        ("wcd.isolate_parts", {"hide": True}),
        ("wcd.isolate_parts", {"text": "Show All Convex Parts", "hide": False}),
        None,
        ("wcd.mark_seams", {}),
        ("wcd.unmark_seams", {}),
    )


class WCD_MT_use(_Entered, bpy.types.Menu):
    """The operators that make something of parts."""

    bl_label = "Use the Parts"
    _entries = (
        ("wcd.separate", "original"),
        ("wcd.explode", {}),
        ("wcd.implode", {}),
        None,
        ("wcd.show_colors", "colors"),
        ("wcd.face_sets", {}),
        ("wcd.color_attribute", {}),
    )


class WCD_MT_hulls(_Entered, bpy.types.Menu):
    """The operators on collision hulls."""

    bl_label = "Collision Hulls"
    _entries = (
        ("wcd.build_hulls", {}),
        ("wcd.make_rigid", "kind"),
        ("wcd.show_hulls", "look"),
        None,
        ("wcd.remove_hulls", {}),
    )


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


def _draw_entry(layout: bpy.types.UILayout, name: str, how: _How) -> None:
    """Draw the button of an operator, or the submenu of its choices."""
    if isinstance(how, str):
        draw_choices(layout, name, how)
        return
    text = {key: value for key, value in how.items() if key == "text"}
    button = layout.operator(name, **text)
    for key in how.keys() - {"text"}:
        setattr(button, key, how[key])


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
