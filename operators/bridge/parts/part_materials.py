"""Where the materials of an object's parts are: in slots, or kept by the mesh.

While colors are an overlay, none of them is in a slot. The mesh keeps them in a custom
property, so that they are there again, as they were, once parts are shown as materials.
"""

from __future__ import annotations

from collections.abc import Mapping
from zlib import crc32

import bpy
import numpy as np

from ..mesh.layers import layers_of
from ..mesh.points import is_cloud
from ..stored.names import (
    GROUP_LAYER,
    KEPT_MATERIALS,
    MATERIAL_TAG,
    OWNER,
    OWNER_LAYER,
    PART_LAYER,
)
from ..stored.restore import read_restore
from .materials import is_of_part, name_of


def is_overlaid(obj: bpy.types.Object) -> bool:
    """Return whether the colors of an object's parts are an overlay."""
    return obj.type == "MESH" and KEPT_MATERIALS in obj.data


def part_materials(obj: bpy.types.Object) -> dict[int, list[bpy.types.Material]]:
    """Return the materials of an object's parts, wherever they are, by their numbers.

    A part has more than one after a join with another object that has its number.
    """
    if is_overlaid(obj):
        return {number: [each] for number, each in kept_materials(obj.data).items()}
    there = obj.data.materials
    return {n: [there[slot] for slot in slots] for n, slots in part_slots(obj).items()}


def part_slots(obj: bpy.types.Object) -> dict[int, list[int]]:
    """Return the slots that hold these materials, none while the mesh keeps them.

    What is in slots then came with another object.
    """
    if is_overlaid(obj) or is_cloud(obj):
        return {}
    return tagged_slots(obj.data)


def tagged_slots(mesh: bpy.types.Mesh) -> dict[int, list[int]]:
    """Return the slots with materials of parts, by the numbers that these have.

    The slots before are left out: a separated part has the material of what it was.
    """
    slots: dict[int, list[int]] = {}
    restore = read_restore(mesh)
    for index, material in enumerate(mesh.materials):
        if is_of_part(material) and not (restore and restore.had(material)):
            slots.setdefault(material[MATERIAL_TAG], []).append(index)
    return slots


def kept_materials(mesh: bpy.types.Mesh) -> dict[int, bpy.types.Material]:
    """Return the materials that a mesh keeps, by the numbers of the parts."""
    found = mesh.get(KEPT_MATERIALS) or {}
    return {int(key): found[key] for key in found.keys() if found[key]}  # noqa: SIM118


def keep(obj: bpy.types.Object, materials: Mapping[int, bpy.types.Material]) -> None:
    """Keep materials on the mesh of an object, by the numbers of the parts.

    Faces are marked, because materials will not tell after a join whose they are, and
    which groups are ours.
    """
    mesh, layers, owner = obj.data, layers_of(obj), _checksum(obj.name)
    mesh[KEPT_MATERIALS] = {str(number): each for number, each in materials.items()}
    mesh[OWNER] = owner
    layers.set_faces(OWNER_LAYER, np.full(len(mesh.polygons), owner, dtype=np.int32))
    numbers = layers.faces(PART_LAYER)
    if numbers is not None:
        marks = np.zeros(max(numbers.max(initial=0), *materials, 0) + 1, dtype=np.int32)
        for number, material in materials.items():
            marks[number] = _checksum(name_of(material))
        layers.set_faces(GROUP_LAYER, marks[numbers])
    layers.finish()


def mark_group(obj: bpy.types.Object, number: int, name: str) -> None:
    """Mark the faces of a part with the name of its group."""
    layers, owner = layers_of(obj), obj.data[OWNER]
    numbers, owners = layers.faces(PART_LAYER), layers.faces(OWNER_LAYER)
    marks = layers.faces(GROUP_LAYER)
    if numbers is not None and owners is not None and marks is not None:
        own = (numbers == number) & (owners == owner)
        layers.set_faces(GROUP_LAYER, np.where(own, _checksum(name), marks))


def marked_groups(obj: bpy.types.Object) -> dict[int, str]:
    """Return the names of an object's groups that marks on faces tell of, by mark."""
    marks = layers_of(obj).faces(GROUP_LAYER)
    if marks is None:
        return {}
    there = set(np.unique(marks).tolist())
    names = {_checksum(each.name): each.name for each in obj.vertex_groups}
    return {mark: name for mark, name in names.items() if mark in there}


def _checksum(name: str) -> int:
    """Return a number above 0 for a name, which attributes of faces can hold."""
    return crc32(name.encode()) >> 1 or 1


def drop_kept(mesh: bpy.types.Mesh) -> list[bpy.types.Material]:
    """Keep no materials any more, and return those that were kept."""
    materials = list(kept_materials(mesh).values())
    for name in (KEPT_MATERIALS, OWNER):
        if name in mesh:
            del mesh[name]
    return materials
