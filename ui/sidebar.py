"""What all panels share: their tab, and the record that they draw."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import bpy

from ..operators.bridge.stored.record import parse_record


class Sidebar:
    """A panel in our tab of the 3D viewport's sidebar."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Convex Parts"


def result_of(obj: bpy.types.Object | None) -> dict[str, Any]:
    """Return the record of an object, empty if it has none of ours."""
    noted = obj and obj.get("wcd")
    return _parsed(noted) if isinstance(noted, str) else {}


def width_of(context: bpy.types.Context) -> float:
    """Return how wide the sidebar is at interface scale 1, in points."""
    return context.region.width / context.preferences.system.ui_scale


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
