"""The table of parts in the sidebar."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import bpy

from ..operators.bridge.parts.figures import PartFigures
from ..operators.bridge.views.isolating import isolating
from ..operators.running import modal
from ..operators.viewport import picking
from ..operators.viewport.shown_figures import shown_figures
from .sidebar import hull_rows_of, hull_rows_of_now, in_powers, width_of

# Rows that are seen at once, at least and at most.
_FEWEST_ROWS = 3
_MOST_ROWS = 9
# Width of a color, as a share of a button's.
_SWATCH = 0.35
# Widths at interface scale 1: of the columns, with a gap; of a name like "Part 04.R";
# of the scroll bar; of all else.
_WIDTHS = {"Faces": 42, "Area": 38, "Rank": 34, "Hull": 34}
_NAME = 68
_SCROLL_BAR = 20
_REST = 122
# A unit of width in Blender's layouts.
_UNIT = 20
# The columns that are left out where there is no room, in this order.
_GO_FIRST = ("Area", "Faces", "Hull", "Rank")


class WCD_UL_parts(bpy.types.UIList):
    """The table of parts: figures of mesh and record, ticks and locks of rows."""

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
        swatch.enabled = obj.data.is_editable  # not if it is linked from a library
        swatch.prop(row, "color", text="")
        line.prop(row, "name", text="", emboss=False)
        texts = _figures(figures, place, hull_rows_of_now(obj))
        for name in headings(hull_rows_of(obj), width_of(context), len(obj.wcd_parts)):
            _cell(line, name, texts[name])
        lock = "LOCKED" if row.locked else "UNLOCKED"
        cell = line.row()
        cell.enabled = modal.busy() is None  # what runs does not look at it any more
        cell.prop(row, "locked", text="", icon=lock, emboss=False)

    def filter_items(
        self, context: bpy.types.Context, obj: bpy.types.Object, name: str
    ) -> tuple[list[int], list[int]]:
        """Hide the rows of parts that have no faces now; else do as Blender's lists.

        Where the search is inverted, Blender shows the rows that are not marked.
        """
        there, rows = places_of(shown_figures(obj)), getattr(obj, name)
        blenders, marked = bpy.types.UI_UL_list, self.bitflag_filter_item
        inverted = self.use_filter_invert
        found = blenders.filter_items_by_name(self.filter_name, marked, rows)
        if not found:  # nothing is searched for
            found = [0 if inverted else marked] * len(rows)
        hidden = marked if inverted else 0
        found = [
            flag if row.number in there else hidden
            for row, flag in zip(rows, found, strict=True)
        ]
        by_name = self.use_filter_sort_alpha
        return found, blenders.sort_items_by_name(rows) if by_name else []


def places_of(figures: PartFigures | None) -> dict[int, int]:
    """Return the places of the parts that an object has, by their numbers."""
    identities = figures.identities if figures else ()
    return {each.number: place for place, each in enumerate(identities)}


def headings(hulls: Sequence[dict[str, Any]], width: float, n_rows: int) -> list[str]:
    """Return the headings of the columns that fit into a table of this width."""
    names = ["Faces", "Area", "Rank"]
    if any(hull["part"] is not None for hull in hulls):
        names.append("Hull")
    room = width - _REST - _NAME - (_SCROLL_BAR if n_rows > _MOST_ROWS else 0)
    for name in _GO_FIRST:
        if name in names and sum(_WIDTHS[each] for each in names) > room:
            names.remove(name)
    return names


def _figures(
    figures: PartFigures, place: int, hulls: Sequence[dict[str, Any]]
) -> dict[str, str]:
    """Return the texts for the faces, area, rank and hull error of a part."""
    faces, area = int(figures.measured_on[place, 0]), figures.measured_on[place, 1]
    number = figures.identities[place].number
    errors = [hull["error"] for hull in hulls if hull["part"] == number]
    rank = figures.ranks[place]
    return {
        "Faces": f"{faces:,}" if faces < 10_000 else f"{faces / 1000:.0f}k",
        "Area": brief(area),
        "Rank": f"{rank:.2f}" if math.isfinite(rank) else "–",
        "Hull": brief(max(errors)) if errors else "–",
    }


def brief(figure: float) -> str:
    """Return the text for an area or a length; all have about four letters.

    So columns line up, and have room for them whatever the size of the object.
    """
    if 0.0 < figure < 0.005 or figure >= 9999.5:
        return in_powers(figure, 0)
    digits = 2 if figure < 10 else 1 if figure < 100 else 0
    return f"{figure:.{digits}f}"


def _cell(line: bpy.types.UILayout, name: str, text: str) -> None:
    """Draw a text at the right of a column as wide as all of its cells."""
    cell = line.row()
    cell.ui_units_x = _WIDTHS[name] / _UNIT
    cell.alignment = "RIGHT"
    cell.label(text=text, translate=False)


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
    heading.label(text="Part", translate=False)
    n_rows = len(obj.wcd_parts)
    for name in headings(hull_rows_of(obj), width, n_rows):
        _cell(heading, name, name)
    heading.label(text="", icon="BLANK1")  # above the padlocks
    if n_rows > _MOST_ROWS:
        heading.label(text="", icon="BLANK1")  # above the scroll bar
    layout.template_list(
        "WCD_UL_parts",
        "",
        obj,
        "wcd_parts",
        obj,
        "wcd_active_part",
        rows=min(max(n_rows, _FEWEST_ROWS), _MOST_ROWS),
        maxrows=_MOST_ROWS,
    )
