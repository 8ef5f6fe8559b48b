"""Carry the user's own normals of corners through edits of a mesh's faces.

Blender stores them relative to the faces around each corner. Where faces are cut or go,
what is stored means other directions; so the directions themselves are kept.
"""

from __future__ import annotations

import bmesh
import bpy

from .attributes import read_floats

# Layer of face corners while faces are edited: the normal that the user gave them.
_LAYER = "wcd_corner_normal"


def keep_normals(bm: bmesh.types.BMesh, mesh: bpy.types.Mesh) -> None:
    """Keep the user's own normals, if there are any, in a mesh just read to edit it."""
    if not mesh.has_custom_normals:
        return
    layer = bm.loops.layers.float_vector.new(_LAYER)
    normals = iter(mesh.corner_normals)
    for face in bm.faces:
        for corner in face.loops:
            corner[layer] = next(normals).vector


def give_back_normals(mesh: bpy.types.Mesh) -> None:
    """Give a mesh with edited faces the normals that were kept, if there are any."""
    kept = mesh.attributes.get(_LAYER)
    if kept is None:
        return
    vectors = read_floats(kept.data, "vector", 3)
    mesh.attributes.remove(kept)
    mesh.normals_split_custom_set(vectors.tolist())
