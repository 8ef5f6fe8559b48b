"""The panels on the use of parts, and on how the parts were found."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..operators.bridge.parts.part_materials import is_overlaid
from ..operators.bridge.views.colors import CHOICES, MATERIALS, OVERLAY
from ..operators.bridge.views.exploding import exploding, slider
from ..operators.viewport import sight_overlay
from .sidebar import Sidebar, draw_choices, line, rank_text, result_of


class WCD_PT_use(Sidebar, bpy.types.Panel):
    """Objects, exploded view, face sets and colors."""

    bl_label = "Use the Parts"
    bl_parent_id = "WCD_PT_main"
    bl_options: ClassVar[set[str]] = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether there are parts."""
        return "parts" in result_of(context.active_object)

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the panel."""
        layout = self.layout
        _exploded_view(layout, context.active_object)
        draw_choices(
            layout,
            "wcd.separate",
            "original",
            text="Separate into Objects",
            icon="OUTLINER_OB_MESH",
        )
        _colors(layout, context.active_object)
        row = layout.row(align=True)
        row.operator("wcd.face_sets", text="Face Sets", icon="FACE_MAPS")
        row.operator("wcd.color_attribute", text="Color Attribute", icon="GROUP_VCOL")


class WCD_PT_why(Sidebar, bpy.types.Panel):
    """Lines of sight, convexity of the selection, pictures."""

    bl_label = "See Why"
    bl_parent_id = "WCD_PT_main"
    bl_options: ClassVar[set[str]] = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the panel."""
        layout = self.layout
        _lines_of_sight(layout)
        if context.mode == "EDIT_MESH":
            layout.operator("wcd.measure_selection", text="Measure Selection")
        obj = context.active_object
        measured = result_of(obj).get("selection")
        if measured:
            line(layout, f"{measured['faces']:,} Faces", rank_text(obj, measured))
        draw_choices(
            layout,
            "wcd.show_picture",
            "picture",
            text="Show in Image Editor",
            icon="IMAGE_DATA",
        )


def _colors(layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
    """Draw the choice of how the colors of parts are shown."""
    row = layout.row(align=True)
    now = OVERLAY if is_overlaid(obj) else MATERIALS
    for choice, label, _ in CHOICES:
        button = row.operator("wcd.show_colors", text=label, depress=choice == now)
        button.colors = choice


def _exploded_view(layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
    """Draw the slider of the exploded view, or the button that makes one."""
    modifier = exploding(obj)
    row = layout.row(align=True)
    if modifier is None:
        row.operator("wcd.explode", text="Exploded View", icon="MOD_EXPLODE")
        return
    owner, path = slider(modifier)
    row.prop(owner, path, text="Exploded View", slider=True, translate=False)
    row.operator("wcd.implode", text="", icon="X")


def _lines_of_sight(layout: bpy.types.UILayout) -> None:
    """Draw the button that shows lines of sight, or hides them."""
    overlay = sight_overlay.current
    if overlay is None:
        layout.operator("wcd.show_sight", text="Lines of Sight", icon="HIDE_OFF")
        return
    layout.operator(
        "wcd.hide_sight", text="Lines of Sight", icon="HIDE_OFF", depress=True
    )
    if overlay.share is None:
        layout.label(
            text="Click the surface", icon="RESTRICT_SELECT_OFF", translate=False
        )
    else:
        line(layout, "Sees", f"{overlay.share:.0%} of the surface")
