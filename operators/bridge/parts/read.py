"""Read the parts of an object: what its faces say, and who the parts are.

The attribute `wcd_part` holds the number of each face's part. After a join, two parts
can have one number; then the materials of the faces tell them apart, or, for copies of
one object, that the same faces come twice.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import bpy
import numpy as np
from bpy.types import Material
from numpy.typing import NDArray

from ..mesh.attributes import IntArray
from ..mesh.known import corner_faces, corner_vertices
from ..mesh.layers import flush_edits, layers_of
from ..mesh.points import count_points, is_cloud
from ..stored.identity import Identity
from ..stored.names import OWNER, OWNER_LAYER, PART_LAYER
from ..stored.noted_parts import identities_of, n_faces_of
from ..stored.record import record_of
from ..stored.restore import read_restore
from .identities import Newcomers
from .kept_materials import is_overlaid, kept_materials
from .materials import color_of, name_of, part_slots


@dataclass(frozen=True, eq=False)
class FoundParts:
    """The parts that the faces of an object say it has.

    Attributes
    ----------
    labels : (P,) int
        Place of the part of each face, or point, in `identities`.
    identities : tuple of Identity
        By number; each has a face.
    origins : tuple of (int, int)
        The number that the faces of each part have, and 0 for a part of the object
        itself, 1 and more for a part that was joined to it.
    """

    labels: NDArray[np.int64]
    identities: tuple[Identity, ...]
    origins: tuple[tuple[int, int], ...]

    @property
    def in_step(self) -> bool:
        """Whether each part has a number of its own on its faces."""
        return all(
            origin == (each.number, 0)
            for each, origin in zip(self.identities, self.origins, strict=True)
        )


def find_parts_on(obj: bpy.types.Object) -> FoundParts | None:
    """Return the parts that an object has now, None if it has none of ours."""
    values = _numbers(obj)
    if values is None:
        return None
    noted = noted_identities(obj)
    # Blender gives any number to faces that the user adds.
    known = {*noted, *part_slots(obj.data)}
    keys = np.clip(values, 0, max(known, default=None)).astype(np.int64)
    stride = int(keys.max()) + 1
    turns = _turns(obj, keys, n_faces_of(record_of(obj)))
    if turns is not None:
        keys += stride * turns
    counts = np.bincount(keys)
    origins = [divmod(int(key), stride)[::-1] for key in np.flatnonzero(counts)]
    identities = _identified(obj, origins, noted)
    order = sorted(range(len(origins)), key=lambda row: identities[row].number)
    places = np.zeros(len(counts), dtype=np.int64)
    places[np.flatnonzero(counts)[order]] = np.arange(len(order))
    return FoundParts(
        labels=places[keys],
        identities=tuple(identities[row] for row in order),
        origins=tuple(origins[row] for row in order),
    )


def _identified(
    obj: bpy.types.Object, origins: list[tuple[int, int]], noted: dict[int, Identity]
) -> list[Identity]:
    """Return who the parts are that faces with these origins belong to.

    Parts that were joined get names, numbers and colors that are free here.
    """
    slots = {} if is_cloud(obj) else part_slots(obj.data)
    own = {number for number, turn in origins if turn == 0} & noted.keys()
    newcomers = Newcomers((noted[number] for number in own), noted.values())
    identities = []
    for number, turn in origins:
        if turn == 0 and number in noted:
            identities.append(noted[number])
            continue
        name = noted[number].name if number in noted else None
        color = noted[number].color if number in noted else None
        if turn < len(slots.get(number, ())):
            material = obj.data.materials[slots[number][turn]]
            name, color = name_of(material), color_of(material)
        identities.append(newcomers.add(name, color))
    return identities


def part_materials(obj: bpy.types.Object, found: FoundParts) -> list[Material | None]:
    """Return the material of each part, in its slot or kept, None without one."""
    if is_overlaid(obj):
        kept = kept_materials(obj.data)
        return [None if turn else kept.get(n) for n, turn in found.origins]
    slots = part_slots(obj.data)
    return [
        obj.data.materials[slots[number][turn]]
        if turn < len(slots.get(number, ()))
        else None
        for number, turn in found.origins
    ]


def part_labels(obj: bpy.types.Object) -> NDArray[np.int64] | None:
    """Return the place of each face's part, None if the object has no parts of ours."""
    found = find_parts_on(obj)
    return None if found is None else found.labels


def part_identities(obj: bpy.types.Object) -> tuple[Identity, ...]:
    """Return who the parts of an object are, by number; empty without parts."""
    found = find_parts_on(obj)
    return () if found is None else found.identities


def _numbers(obj: bpy.types.Object) -> IntArray | None:
    """Return the attribute with the parts, None if it does not fit the faces."""
    numbers = layers_of(obj).faces(PART_LAYER)
    if numbers is None or not len(numbers) or read_restore(obj.data) is None:
        return None
    if is_cloud(obj):
        return numbers if len(numbers) == count_points(obj) else None
    # It may be from when the mesh was a cloud of points.
    fits = obj.data.is_editmode or len(numbers) == len(obj.data.polygons)
    return numbers if fits else None


def noted_identities(obj: bpy.types.Object) -> dict[int, Identity]:
    """Return the identities in the record of an object, by the numbers on its faces.

    A color that the user gave to the material counts.
    """
    noted = {each.number: each for each in identities_of(record_of(obj))}
    if is_cloud(obj):
        return noted
    for number, (slot, *_) in part_slots(obj.data).items():
        if number in noted:
            color = color_of(obj.data.materials[slot])
            noted[number] = replace(noted[number], color=color)
    return noted


def _turns(
    obj: bpy.types.Object, numbers: NDArray[np.int64], n_noted: int
) -> NDArray[np.int64] | None:
    """Return 0 for faces of the object's own parts, 1 and more for those joined to it.

    None if all are its own.
    """
    if is_cloud(obj):
        return None
    owners = layers_of(obj).faces(OWNER_LAYER)
    if owners is not None and len(owners) == len(numbers):
        turns = _turns_by_owner(owners, obj.data.get(OWNER, 0))
        if turns is not None:
            return turns
    slots = part_slots(obj.data)
    if any(len(places) > 1 for places in slots.values()):
        return _turns_by_material(obj, numbers, slots)
    n_copies, odd = divmod(len(numbers), n_noted) if n_noted else (0, 0)
    if odd or n_copies < 2:
        return None
    runs = numbers.reshape(n_copies, n_noted)
    if (runs != runs[0]).any() or _touch(obj, n_noted):
        return None
    return np.repeat(np.arange(n_copies), n_noted)


def _turns_by_owner(owners: IntArray, own: int) -> NDArray[np.int64] | None:
    """Return 0 for faces of the object itself, and for each other owner a number."""
    others, turns = np.unique(owners[owners != own], return_inverse=True)
    if not len(others):
        return None
    found = np.zeros(len(owners), dtype=np.int64)
    found[owners != own] = turns + 1
    return found


def _turns_by_material(
    obj: bpy.types.Object, numbers: NDArray[np.int64], slots: dict[int, list[int]]
) -> NDArray[np.int64]:
    """Return which of the materials with the number of its part each face has."""
    indices = layers_of(obj).material_indices()
    turns = np.zeros_like(numbers)
    if indices is None:
        return turns
    for number, places in slots.items():
        for turn, slot in enumerate(places):
            turns[(numbers == number) & (indices == slot)] = turn
    return turns


def _touch(obj: bpy.types.Object, n_faces: int) -> bool:
    """Return whether runs of faces, each as long, share vertices."""
    flush_edits(obj)
    runs = corner_faces(obj.data) // n_faces
    vertices = corner_vertices(obj.data)
    used = np.unique(np.stack([vertices, runs], axis=1), axis=0)[:, 0]
    return len(np.unique(used)) < len(used)
