"""What all panels share: their tab, the record that they draw, and their texts."""

from __future__ import annotations

import textwrap
from functools import lru_cache
from typing import Any

import bpy

from ..operators.bridge.hulls.listed import listed_hulls
from ..operators.bridge.stored.names import RESULT
from ..operators.bridge.stored.noted_hulls import noted_hulls
from ..operators.bridge.stored.record import parse_record
from ..operators.viewport.shown_figures import is_of_now, shown_figures

# What stands for figures of a mesh that has changed since.
OUT_OF_DATE = "out of date"
# Share of the width that Blender gives to the names of settings.
LABELS = 0.4
# Widths at interface scale 1: of tabs, margins and an icon together; of a letter.
_MARGINS = 80
_LETTER = 6


class Sidebar:
    """A panel in our tab of the 3D viewport's sidebar."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Convex Parts"


def result_of(obj: bpy.types.Object | None) -> dict[str, Any]:
    """Return the record of an object, empty if it has none of ours.

    It tells of parts only while the object has some.
    """
    figures = shown_figures(obj)
    if figures is not None and figures.record:
        return figures.record
    noted = obj and obj.get(RESULT)
    record = _parsed(noted) if isinstance(noted, str) else {}
    return {key: value for key, value in record.items() if key != "parts"}


def hull_rows_of(obj: bpy.types.Object) -> list[dict[str, Any]]:
    """Return what is noted of an object's hulls, without those that were deleted.

    Hulls that the user renamed have their new names. "object" is the hull itself.
    """
    noted = noted_hulls(result_of(obj))
    return [
        {**noted[row], "name": hull.name, "object": hull}
        for row, hull in listed_hulls(obj, noted).items()
    ]


def hull_rows_of_now(obj: bpy.types.Object) -> list[dict[str, Any]]:
    """Return the same if their figures are of the faces that the object has now."""
    hulls = hull_rows_of(obj)
    return hulls if hulls and is_of_now(obj, result_of(obj)["hulls"]) else []


def rank_text(obj: bpy.types.Object, measured: dict[str, Any]) -> str:
    """Return the text for a convexity rank that was measured on an object."""
    if not is_of_now(obj, measured):
        return OUT_OF_DATE
    error = measured["standard_error"]
    return f"{measured['convexity_rank']:.3f}" + (f" ± {error:.3f}" if error else "")


def in_powers(figure: float, digits: int) -> str:
    """Return a figure as a power of ten in few letters, such as 6e4 or 3.1e-5."""
    power = f"{figure:.{digits}e}"
    return power.replace("e+", "e").replace("e0", "e").replace("e-0", "e-")


def width_of(context: bpy.types.Context) -> float:
    """Return how wide the sidebar is at interface scale 1, in points."""
    return context.region.width / context.preferences.system.ui_scale


def paragraph(
    layout: bpy.types.UILayout,
    text: str,
    context: bpy.types.Context,
    icon: str = "ERROR",
) -> None:
    """Draw a sentence, by default a warning, broken into lines that fit the sidebar."""
    width = int((width_of(context) - _MARGINS) / _LETTER)
    column = layout.column(align=True)
    column.scale_y = 0.8
    for number, words in enumerate(textwrap.wrap(text, max(width, 10))):
        column.label(text=words, icon="BLANK1" if number else icon, translate=False)


def line(layout: bpy.types.UILayout, name: str, value: str) -> None:
    """Draw a name and a value."""
    split = layout.split(factor=LABELS)
    split.label(text=name, translate=False)
    split.label(text=value, translate=False)


def draw_choices(
    layout: bpy.types.UILayout, operator: str, choice: str, **look: str
) -> None:
    """Draw the menu of an operator's choices.

    If the operator cannot run now, a greyed button is drawn, which says why; a menu
    would not.
    """
    module, name = operator.split(".")
    if getattr(getattr(bpy.ops, module), name).poll():
        layout.operator_menu_enum(operator, choice, **look)
    else:
        layout.operator(operator, **look)


# Each row of each panel asks for it, many times a second.
@lru_cache(maxsize=1)
def _parsed(noted: str) -> dict[str, Any]:
    return parse_record(noted) or {}
