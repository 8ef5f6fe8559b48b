"""The table of parts in the sidebar, and the buttons that act on its rows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import bpy

from ..operators.bridge.parts.figures import PartFigures
from ..operators.bridge.views.isolating import isolating
from ..operators.viewport import picking
from .shown_figures import shown_figures
from .sidebar import Sidebar, hulls_of, width_of

_ROWS = 6
# Width of a color, as a share of a button's.
_SWATCH = 0.35
# Widths at interface scale 1: of a column of figures; of a name like
# "Part 04.R"; of all else.
_FIGURE = 30
_NAME = 62
_REST = 134
# The columns that are left out where there is no room, in this order.
_GO_FIRST = ("Area", "Faces", "Hull")


class WCD_UL_parts(bpy.types.UIList):
    """The table of parts: figures come from the record, ticks and locks from rows."""

    def draw_item(
        self,
        context: bpy.types.Context,
        layout: bpy.types.UILayout,
        obj: bpy.types.Object,
        row: Any,
        icon: int,
        active_data: bpy.types.Object,
        active_property: str,
        index: int,
    ) -> None:
        """Draw a row."""
        figures = shown_figures(obj)
        place = places_of(figures).get(row.number)
        if figures is None or place is None:
            return
        line = layout.row(align=True)
        tick = "CHECKBOX_HLT" if row.chosen else "CHECKBOX_DEHLT"
        line.prop(row, "chosen", text="", icon=tick, emboss=False)
        swatch = line.row()
        swatch.scale_x = _SWATCH
        swatch.prop(row, "color", text="")
        width = width_of(context)
        columns = headings(hulls_of(obj), width)
        split = line.split(factor=_name_share(width, len(columns)))
        split.prop(row, "name", text="", emboss=False)
        texts = _figures(figures, place, hulls_of(obj))
        _numbers(split, *(texts[name] for name in columns))
        lock = "LOCKED" if row.locked else "UNLOCKED"
        line.prop(row, "locked", text="", icon=lock, emboss=False)

    def filter_items(
        self, context: bpy.types.Context, obj: bpy.types.Object, name: str
    ) -> tuple[list[int], list[int]]:
        """Hide the rows of parts that have no faces now; keep Blender's search."""
        there = places_of(shown_figures(obj))
        rows = getattr(obj, name)
        wanted = self.filter_name.lower()
        shown = [
            self.bitflag_filter_item
            if row.number in there and wanted in row.name.lower()
            else 0
            for row in rows
        ]
        return shown, []


def places_of(figures: PartFigures | None) -> dict[int, int]:
    """Return the places of the parts that an object has, by their numbers."""
    identities = figures.identities if figures else ()
    return {each.number: place for place, each in enumerate(identities)}


def headings(hulls: Sequence[dict[str, Any]], width: float) -> list[str]:
    """Return the headings of the columns that fit into a table of this width."""
    names = ["Faces", "Area", "Rank"]
    if any(hull["part"] is not None for hull in hulls):
        names.append("Hull")
    room = max(int((width - _REST - _NAME) / _FIGURE), 1)
    dropped = [name for name in _GO_FIRST if name in names][: max(len(names) - room, 0)]
    return [name for name in names if name not in dropped]


def _name_share(width: float, n_figures: int) -> float:
    """Return the name's share of the width that it has together with the figures."""
    return 1 - n_figures * _FIGURE / max(width - _REST, n_figures * _FIGURE + _NAME)


def _figures(
    figures: PartFigures, place: int, hulls: Sequence[dict[str, Any]]
) -> dict[str, str]:
    """Return the texts for the faces, area, rank and hull error of a part."""
    faces, area = int(figures.measured_on[place, 0]), figures.measured_on[place, 1]
    errors = [hull["error"] for hull in hulls if hull["part"] == place]
    rank = figures.ranks[place]
    return {
        "Faces": f"{faces:,}" if faces < 10_000 else f"{faces / 1000:.0f}k",
        "Area": _area(area),
        "Rank": f"{rank:.2f}" if math.isfinite(rank) else "–",
        "Hull": f"{max(errors):.2f}" if errors else "–",
    }


def _area(area: float) -> str:
    """Return the text for an area; all are about as long, so that columns line up."""
    if area < 0.01:
        return f"{area:.0e}"
    return next(f"{area:.{n}f}" for n in (2, 1, 0) if area < 10 ** (3 - n) or n == 0)


def _numbers(layout: bpy.types.UILayout, *texts: str) -> None:
    """Draw texts side by side, at the right."""
    columns = layout.row(align=True)
    columns.alignment = "RIGHT"
    for text in texts:
        columns.label(text=text)


def draw_table(layout: bpy.types.UILayout, obj: bpy.types.Object, width: float) -> None:
    """Draw the parts of an object, in a sidebar of this width."""
    row = layout.row(align=True)
    row.use_property_split = False
    picked = picking.current is not None
    row.operator("wcd.pick_parts", text="Pick Parts", icon="EYEDROPPER", depress=picked)
    row.prop(bpy.context.scene.wcd, "highlight", toggle=True)
    if isolating(obj) is not None:
        button = row.operator(
            "wcd.isolate_parts", text="", icon="HIDE_OFF", depress=True
        )
        button.hide = False
    heading = layout.row(align=True)
    heading.label(text="", icon="BLANK1")
    heading.label(text="", icon="BLANK1")
    columns = headings(hulls_of(obj), width)
    split = heading.split(factor=_name_share(width, len(columns)))
    split.label(text="Part")
    _numbers(split, *columns)
    heading.label(text="", icon="BLANK1")
    layout.template_list(
        "WCD_UL_parts", "", obj, "wcd_parts", obj, "wcd_active_part", rows=_ROWS
    )


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
        layout = self.layout
        _buttons(
            layout,
            ("wcd.select_parts", "Select", {}),
            ("wcd.isolate_parts", "Isolate", {"hide": True}),
            ("wcd.isolate_parts", "Show All", {"hide": False}),
            ("wcd.frame_parts", "Frame", {}),
        )
        column = layout.column(align=True)
        _buttons(
            column,
            ("wcd.merge_parts", "Merge", {}),
            ("wcd.assign_faces", "Assign Faces", {}),
        )
        _buttons(
            column,
            ("wcd.split_parts", "Split in Two", {"parts": 2}),
            ("wcd.split_parts", "Split by ψ", {"parts": 0}),
        )
        _buttons(
            column,
            ("wcd.mirror_parts", "Mirror to -X", {"direction": "TO_NEGATIVE"}),
            ("wcd.mirror_parts", "Mirror to +X", {"direction": "TO_POSITIVE"}),
        )
        column = layout.column(align=True)
        _buttons(
            column,
            ("wcd.smooth_seams", "Smooth Seams", {}),
            ("wcd.mark_seams", "Mark Seams", {}),
        )
        _buttons(column, ("wcd.select_boundary", "Select Boundary", {}))


def _buttons(
    layout: bpy.types.UILayout, *buttons: tuple[str, str, dict[str, Any]]
) -> None:
    """Draw buttons side by side."""
    row = layout.row(align=True)
    for operator, text, settings in buttons:
        properties = row.operator(operator, text=text)
        for name, value in settings.items():
            setattr(properties, name, value)
