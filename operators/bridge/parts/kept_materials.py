"""The materials of parts whose colors are an overlay: none of them is in a slot.

The mesh keeps them in a custom property, so that they are there again, as they were,
once parts are shown as materials.
"""

from __future__ import annotations

from collections.abc import Mapping
from zlib import crc32

import bpy
import numpy as np

from ..mesh.layers import layers_of
from ..stored.names import OVERLAY, OWNER, OWNER_LAYER


def is_overlaid(obj: bpy.types.Object) -> bool:
    """Return whether the colors of an object's parts are an overlay."""
    return obj.type == "MESH" and OVERLAY in obj.data


def kept_materials(mesh: bpy.types.Mesh) -> dict[int, bpy.types.Material]:
    """Return the materials that a mesh keeps, by the numbers of the parts."""
    found = mesh.get(OVERLAY) or {}
    return {int(key): found[key] for key in found.keys() if found[key]}  # noqa: SIM118


def keep(obj: bpy.types.Object, materials: Mapping[int, bpy.types.Material]) -> None:
    """Keep materials on the mesh of an object, by the numbers of the parts.

    Faces are marked, because materials will not tell after a join whose they are.
    """
    mesh, layers = obj.data, layers_of(obj)
    mesh[OVERLAY] = {str(number): each for number, each in materials.items()}
    owner = crc32(obj.name.encode()) >> 1 or 1
    mesh[OWNER] = owner
    layers.set_faces(OWNER_LAYER, np.full(len(mesh.polygons), owner, dtype=np.int32))
    layers.finish()


def drop_kept(mesh: bpy.types.Mesh) -> list[bpy.types.Material]:
    """Keep no materials any more, and return those that were kept."""
    materials = list(kept_materials(mesh).values())
    for name in (OVERLAY, OWNER):
        if name in mesh:
            del mesh[name]
    return materials
