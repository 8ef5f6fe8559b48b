"""Numbers objects that have one name in an order that is always the same."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable
from typing import Any

import bpy

# What Blender appends to a name that is taken. Names of USD hold no dots, and fewer
# digits, as in "Wheel.1", belong to a name. `plain_name` asks something else: which
# digits Blender would count on from.
_NUMBER = re.compile(r"\.\d{3,}$")
_DIGITS = 5  # of coordinates that are compared


def number_in_order(objects: Iterable[bpy.types.Object]) -> None:
    """Give objects of one name their numbers, as in "Ring.001", in a fixed order.

    The order is that of the names above them, of their vertices and of their places.
    Their data get the same names.
    """
    groups = defaultdict(list)
    for obj in objects:
        groups[unnumbered(obj)].append(obj)
    for name, group in sorted(groups.items()):
        if len(group) == 1:
            continue
        group.sort(key=_place)
        named = [[obj, *_data_of(obj)] for obj in group]
        for owner in (owner for owners in named for owner in owners):
            owner.name = "."  # frees the names
        for number, owners in enumerate(named):
            for owner in owners:
                owner.name = f"{name}.{number:03d}" if number else name


def _data_of(obj: bpy.types.Object) -> list[bpy.types.ID]:
    """Return the data of an object, unless it has none or shares it."""
    return [obj.data] if obj.data and obj.data.users == 1 else []


def unnumbered(owner: bpy.types.ID) -> str:
    """Return the name of an object or mesh without Blender's number."""
    return _NUMBER.sub("", owner.name)


def _place(obj: bpy.types.Object) -> tuple[Any, ...]:
    """Return what tells objects of one name apart."""
    above, parent = [], obj.parent
    while parent:
        above.append(unnumbered(parent))
        parent = parent.parent
    size = len(getattr(obj.data, "vertices", ()))
    numbers = [number for row in obj.matrix_world for number in row]
    return above[::-1], size, [round(number, _DIGITS) for number in numbers]
