"""What all panels share: the tab they are in, and the record they draw."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import bpy

from ..core.record import parse_record


class Sidebar:
    """A panel in our tab of the 3D viewport's sidebar."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Convex Parts"


def result_of(obj: bpy.types.Object | None) -> dict[str, Any]:
    """Return what was noted on an object, empty if nothing or not ours."""
    noted = obj and obj.get("wcd")
    return _parsed(noted) if isinstance(noted, str) else {}


# Drawn many times a second, each row by itself, from one and the same text.
@lru_cache(maxsize=1)
def _parsed(noted: str) -> dict[str, Any]:
    return parse_record(noted) or {}
