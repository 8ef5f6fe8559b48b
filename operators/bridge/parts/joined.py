"""What faces tell of parts that came to an object by a join.

Two parts can have one number then, and faces of an object without parts have number 0.
Marks of overlays, materials of parts, or runs of the same faces tell them apart.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import bpy
import numpy as np

from ....core.steps.arrays import BoolArray, Int32Array, IntArray
from ..mesh.layers import layers_of
from ..mesh.points import is_cloud
from ..stored.identity import Color
from ..stored.names import GROUP_LAYER, MATERIAL_TAG, OWNER, OWNER_LAYER
from ..stored.noted_parts import entry_of, n_faces_of
from ..stored.record import record_of
from .materials import color_of, is_ours, name_of
from .part_materials import marked_groups, part_slots, tagged_slots


class Origin(NamedTuple):
    """Where a part comes from, as far as its faces tell.

    Attributes
    ----------
    number : int
        What its faces have in the attribute. Other parts may have the same.
    turn : int
        0 for a part of the object itself, 1 and more for those joined to it.
    """

    number: int
    turn: int


def highest_number(
    obj: bpy.types.Object, values: Int32Array, noted: Iterable[int]
) -> int:
    """Return the highest number of a part that faces of an object can have.

    `values` are those of the faces, `noted` those in the record.
    """
    known = [0, *noted, *(m[MATERIAL_TAG] for m in obj.data.materials if is_ours(m))]
    groups = marked_groups(obj) if values.max() > max(known) else {}
    if groups:
        marks = layers_of(obj).faces(GROUP_LAYER)
        assert marks is not None  # they tell of the groups
        known.append(values[np.isin(marks, list(groups))].max())
    return int(max(known))


def told_of_part(
    obj: bpy.types.Object, origin: Origin, face: int
) -> tuple[str | None, Color | None]:
    """Return the name and color that a part had, None for what its faces do not tell.

    Any `face` of the part serves.
    """
    if is_cloud(obj):
        return None, None
    layers, slots = layers_of(obj), part_slots(obj).get(origin.number, [])
    if origin.turn < len(slots):
        slot = slots[origin.turn]
    else:  # as while colors are an overlay
        marks, indices = layers.faces(GROUP_LAYER), layers.material_indices()
        if marks is not None and (name := marked_groups(obj).get(int(marks[face]))):
            return name, None
        slot = 0 if indices is None else int(indices[face])
        if slot not in tagged_slots(obj.data).get(origin.number, ()):
            return None, None
    material = obj.data.materials[slot]
    return name_of(material), color_of(material)


def turns_of_faces(obj: bpy.types.Object, numbers: IntArray) -> IntArray | None:
    """Return the turn of each face's part, see `Origin`; None if all are 0."""
    if is_cloud(obj):
        return None
    owners = layers_of(obj).faces(OWNER_LAYER)
    if owners is not None and len(owners) == len(numbers):
        turns = _turns_by_owner(owners, obj.data.get(OWNER, 0))
        if turns is not None:
            return turns
    turns = _turns_by_material(obj, numbers)
    return _turns_of_copies(obj, numbers) if turns is None else turns


def _turns_by_owner(owners: Int32Array, own: int) -> IntArray | None:
    """Return 0 for faces of the object itself, and for each other owner a number."""
    # Faces that nobody owns come last: they are of no part.
    others, turns = np.unique(-owners[owners != own], return_inverse=True)
    if not len(others):
        return None
    found = np.zeros(len(owners), dtype=np.int64)
    found[owners != own] = turns + 1
    return found


def _turns_by_material(obj: bpy.types.Object, numbers: IntArray) -> IntArray | None:
    """Return which of the materials with the number of its part each face has.

    Faces of an object without parts have another turn. None if all faces have 0.
    """
    slots, indices = part_slots(obj), layers_of(obj).material_indices()
    if indices is None:
        return None
    turns = np.zeros_like(numbers)
    for number, places in slots.items():
        for turn, slot in enumerate(places[1:], start=1):
            turns[(numbers == number) & (indices == slot)] = turn
    if 0 in slots:
        turns[_without_part(obj, numbers, indices, slots)] = len(slots[0])
    return turns if turns.any() else None


def _without_part(
    obj: bpy.types.Object,
    numbers: IntArray,
    indices: Int32Array,
    slots: dict[int, list[int]],
) -> BoolArray:
    """Return which faces came with an object without parts; Blender gives them 0.

    They have a material of the user's, and all faces that part 0 had have its own.
    """
    ours = np.concatenate(list(slots.values()))
    others = (numbers == 0) & ~np.isin(indices, ours)
    record = record_of(obj)
    entry = entry_of(record, 0)
    n_own = np.count_nonzero((numbers == 0) & (indices == slots[0][0]))
    complete = entry["faces"] == n_own if entry else not record
    return others if complete else np.zeros_like(others)


def _turns_of_copies(obj: bpy.types.Object, numbers: IntArray) -> IntArray | None:
    """Return which of the copies of the object, joined to it, each face is of."""
    n_noted = n_faces_of(record_of(obj))
    n_copies, odd = divmod(len(numbers), n_noted) if n_noted else (0, 0)
    if odd or n_copies < 2:
        return None
    runs = numbers.reshape(n_copies, n_noted)
    if (runs != runs[0]).any() or _touch(obj, n_noted):
        return None
    return np.repeat(np.arange(n_copies), n_noted)


def _touch(obj: bpy.types.Object, n_faces: int) -> bool:
    """Return whether runs of `n_faces` faces share vertices."""
    vertices, faces = layers_of(obj).corners()
    used = np.unique(np.stack([vertices, faces // n_faces], axis=1), axis=0)[:, 0]
    return len(np.unique(used)) < len(used)
