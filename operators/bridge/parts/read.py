"""Read the parts of an object: what its faces say, and who the parts are.

The attribute `wcd_part` holds the number of each face's part. After a join, two parts
can have one number; then the materials of the faces tell them apart, or, for copies of
one object, that the same faces come twice: see `joined.py`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import bpy
import numpy as np
from bpy.types import Material

from ....core.errors import DecompositionError
from ....core.steps.arrays import Int32Array, IntArray
from ..mesh.layers import flush_edits, layers_of
from ..mesh.points import count_points, is_cloud
from ..stored.identity import Color, Identity
from ..stored.names import PART_LAYER
from ..stored.noted_parts import identities_of
from ..stored.record import record_of
from ..stored.restore import read_restore
from .identities import Newcomers
from .joined import Origin, highest_number, told_of_part, turns_of_faces
from .materials import color_of
from .part_materials import part_materials, part_slots


@dataclass(frozen=True, eq=False)
class FoundParts:
    """The parts that the faces of an object say it has.

    Attributes
    ----------
    labels : (P,) int
        Place of the part of each face, or point, in `identities`.
    identities : tuple of Identity
        By number; each has a face.
    origins : tuple of Origin
        Where each part comes from.
    """

    labels: IntArray
    identities: tuple[Identity, ...]
    origins: tuple[Origin, ...]

    @property
    def numbers(self) -> Int32Array:
        """The number of the part of each face, or point, (P,): its own, in any case."""
        own = np.array([each.number for each in self.identities], dtype=np.int32)
        return own[self.labels]

    @property
    def face_sets(self) -> Int32Array:
        """The face set that shows the part of each face, (P,).

        It follows from the number, so that it stays when another part vanishes.
        """
        return self.numbers + 1

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
    keys = np.clip(values, 0, highest_number(obj, values, noted)).astype(np.int64)
    stride = int(keys.max()) + 1
    turns = turns_of_faces(obj, keys)
    if turns is not None:
        keys += stride * turns
    counts = np.bincount(keys)
    there = np.flatnonzero(counts)
    origins = [Origin(key % stride, key // stride) for key in there.tolist()]
    told = {
        origin: told_of_part(obj, origin, int(np.argmax(keys == key)))
        for origin, key in zip(origins, there, strict=True)
        if origin.turn or origin.number not in noted
    }
    identities = _identified(origins, noted, told)
    order = sorted(range(len(origins)), key=lambda row: identities[row].number)
    places = np.zeros(len(counts), dtype=np.int64)
    places[there[order]] = np.arange(len(order))
    return FoundParts(
        labels=places[keys],
        identities=tuple(identities[row] for row in order),
        origins=tuple(origins[row] for row in order),
    )


def _identified(
    origins: list[Origin],
    noted: dict[int, Identity],
    told: dict[Origin, tuple[str | None, Color | None]],
) -> list[Identity]:
    """Return who the parts are that faces with these origins belong to.

    Parts that are not noted get names, numbers and colors that are free here: near to
    those that they are `told` to have, before parts that have none.
    """
    own = [origin for origin in origins if origin not in told]
    found = {origin: noted[origin.number] for origin in own}
    newcomers = Newcomers(found.values(), noted.values())
    for origin in sorted(told, key=lambda each: told[each][0] is None):
        found[origin] = newcomers.add(*told[origin])
    return [found[origin] for origin in origins]


def materials_of(obj: bpy.types.Object, found: FoundParts) -> list[Material | None]:
    """Return the material of each part, None without one."""
    there = part_materials(obj)
    return [
        own[turn] if turn < len(own := there.get(number, [])) else None
        for number, turn in found.origins
    ]


def parts_on(obj: bpy.types.Object) -> FoundParts:
    """Return the parts that an object has now; raise if it has none of ours.

    What was done in Edit Mode is on its mesh then, too.
    """
    flush_edits(obj)
    found = find_parts_on(obj)
    if found is None:
        raise DecompositionError(loss_of(obj))
    return found


def loss_of(obj: bpy.types.Object) -> str:
    """Return what to say of an object that notes parts and has none."""
    return f"{obj.name} has lost its parts; decompose it again."


def part_labels(obj: bpy.types.Object) -> IntArray | None:
    """Return the place of each face's part, None if the object has no parts of ours."""
    found = find_parts_on(obj)
    return None if found is None else found.labels


def part_identities(obj: bpy.types.Object) -> tuple[Identity, ...]:
    """Return who the parts of an object are, by number; empty without parts."""
    found = find_parts_on(obj)
    return () if found is None else found.identities


def _numbers(obj: bpy.types.Object) -> Int32Array | None:
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
    for number, (slot, *_) in part_slots(obj).items():
        if number in noted:
            color = color_of(obj.data.materials[slot])
            noted[number] = replace(noted[number], color=color)
    return noted
