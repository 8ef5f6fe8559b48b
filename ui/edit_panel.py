"""The panel with the buttons that edit parts; they say which parts they act on."""

from __future__ import annotations

from collections.abc import Sequence

import blf
import bpy

from ..operators.bridge.parts.rows import active_row, chosen_numbers
from ..operators.viewport.shown_figures import shown_figures
from .parts_table import places_of
from .sidebar import Sidebar, width_of

# Widths at interface scale 1: of tabs and margins; of the margins of the text of a
# button, and of a label.
_EDGES = 53
_PADDING = 16
_LABEL_PADDING = 6
# Share of the width for what stands before two or three buttons.
_BEFORE = 0.5
# Size of the letters in panels, in points.
_LETTERS = 11.0


class WCD_PT_edit(Sidebar, bpy.types.Panel):
    """The buttons that edit parts."""

    bl_label = "Edit Parts"
    bl_parent_id = "WCD_PT_parts"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether there are rows."""
        obj = context.active_object
        return obj is not None and bool(obj.wcd_parts)

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the panel."""
        obj, room = context.active_object, width_of(context) - _EDGES
        names = acted_on(obj)
        active = active_row(obj)

        def half(verb: str, of: Sequence[str] = names) -> str:
            return fitting(verb, of, room / 2 - _PADDING)

        def label(verb: str) -> str:
            return fitting(verb, names, room * _BEFORE - _LABEL_PADDING)

        column = self.layout.column(align=True)
        row = column.row(align=True)
        row.operator("wcd.select_parts", text=half("Select"))
        row.operator("wcd.frame_parts", text=half("Frame"))
        row = column.row(align=True)
        row.operator("wcd.isolate_parts", text=half("Isolate")).hide = True
        row.operator("wcd.isolate_parts", text="Show All").hide = False
        column = self.layout.column(align=True)
        row = column.row(align=True)
        row.operator("wcd.merge_parts", text=half("Merge") if names[1:] else "Merge")
        row.operator(
            "wcd.assign_faces", text=half("Add to", [active.name] if active else [])
        )
        row = _labelled(column, label("Split"))
        row.operator("wcd.split_parts", text="In Two").parts = 2
        row.operator("wcd.split_parts", text="By ψ").parts = 0
        row = _labelled(column, label("Seams of"))
        row.operator("wcd.smooth_seams", text="Smooth")
        row.operator("wcd.select_boundary", text="Select")
        row = _labelled(column, "All Seams")
        row.operator("wcd.mark_seams", text="Mark")
        row.operator("wcd.unmark_seams", text="Unmark")
        row = _labelled(column, "Mirror to")
        row.operator("wcd.mirror_parts", text="-X").direction = "TO_NEGATIVE"
        row.operator("wcd.mirror_parts", text="+X").direction = "TO_POSITIVE"


def acted_on(obj: bpy.types.Object) -> list[str]:
    """Return the names of the parts that buttons act on now."""
    chosen, there = chosen_numbers(obj), places_of(shown_figures(obj))
    return [
        row.name
        for row in obj.wcd_parts
        if row.number in chosen and row.number in there
    ]


def fitting(verb: str, names: Sequence[str], room: float) -> str:
    """Return what is done to which parts, in as many letters as there is room for."""
    if len(names) > 1:
        return f"{verb} {len(names)} Parts"
    if not names:
        return verb
    (name,) = names
    text, n_kept = f"{verb} {name}", len(name)
    blf.size(0, _LETTERS)
    while n_kept and blf.dimensions(0, text)[0] > room:
        n_kept -= 1
        text = f"{verb} {name[:n_kept].rstrip()}…" if n_kept else verb
    return text


def _labelled(layout: bpy.types.UILayout, text: str) -> bpy.types.UILayout:
    """Draw a text, and return a row for the buttons behind it."""
    split = layout.split(factor=_BEFORE, align=True)
    split.label(text=text, translate=False)
    return split.row(align=True)
