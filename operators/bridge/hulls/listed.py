"""Find the hulls of an object, by whatever names they have now."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bpy

from ..stored.names import HULL_TAG
from ..stored.noted_hulls import figures_on

# Figures by which a hull is known that the user renamed.
_FIGURES = ("kind", "error", "volume", "vertices")


def is_hull(obj: bpy.types.Object) -> bool:
    """Return whether an object is a hull of its parent."""
    return HULL_TAG in obj and obj.parent is not None


def hulls_of(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """Return the hulls of an object, sorted by name."""
    return sorted((c for c in obj.children if HULL_TAG in c), key=lambda c: c.name)


def owners_of_hulls() -> set[bpy.types.Object]:
    """Return the objects that have hulls: one look at the file tells of all."""
    return {each.parent for each in bpy.data.objects if is_hull(each)}


def listed_hulls(
    obj: bpy.types.Object, noted: Sequence[dict[str, Any]]
) -> dict[int, bpy.types.Object]:
    """Return the hulls of an object that are noted, by row; deleted ones are missing.

    `noted` is what the object notes of each hull. The rows are in their order.
    """
    named = (bpy.data.objects.get(each["name"]) for each in noted)
    found = {
        row: hull
        for row, hull in enumerate(named)
        if hull is not None and hull.parent == obj and HULL_TAG in hull
    }
    if len(found) < len(noted):  # it takes a look at all objects of the file
        others = [hull for hull in hulls_of(obj) if hull not in found.values()]
        for row, each in enumerate(noted):
            same = [hull for hull in others if _is_noted_as(hull, each)]
            if row not in found and same:
                found[row] = same[0]
                others.remove(same[0])
    return dict(sorted(found.items()))


def _is_noted_as(hull: bpy.types.Object, noted: dict[str, Any]) -> bool:
    """Return whether a hull has the figures that are noted of one."""
    own = figures_on(hull)
    return all(own.get(figure) == noted.get(figure) for figure in _FIGURES)
