"""What all panels share: the tab they are in, and the record they draw."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import bpy

from ..operators.bridge.stored.record_text import parse_record


class Sidebar:
    """A panel in our tab of the 3D viewport's sidebar."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Convex Parts"


def result_of(obj: bpy.types.Object | None) -> dict[str, Any]:
    """Return what was noted on an object, empty if nothing or not ours."""
    noted = obj and obj.get("wcd")
    return _parsed(noted) if isinstance(noted, str) else {}


def width_of(context: bpy.types.Context) -> float:
    """Return how wide the sidebar is at interface scale 1, in points."""
    return context.region.width / context.preferences.system.ui_scale


def draw_choices(
    layout: bpy.types.UILayout, operator: str, choice: str, **look: str
) -> None:
    """Draw the menu of an operator's choices.

    If it cannot run now, a button in its place is greyed and says why; a menu does not.
    """
    module, name = operator.split(".")
    if getattr(getattr(bpy.ops, module), name).poll():
        layout.operator_menu_enum(operator, choice, **look)
    else:
        layout.operator(operator, **look)


# Drawn many times a second, each row by itself, from one and the same text.
@lru_cache(maxsize=1)
def _parsed(noted: str) -> dict[str, Any]:
    return parse_record(noted) or {}
