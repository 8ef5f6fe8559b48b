"""Parts as objects of their own."""

from __future__ import annotations

import bmesh
import bpy
import numpy as np
from numpy.typing import NDArray

from ....core.errors import DecompositionError
from .beside import new_collection
from .erase import clear
from .exploding import implode
from .materials import part_materials
from .parted import part_identities, part_labels


def separate(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """Make an object of each part, and return them; the object itself stays.

    They are copies of the object as it was before it was decomposed, with the faces of
    their part alone: modifiers, constraints, groups and attributes are there. Where the
    mesh has no materials, they show their part's.
    """
    labels = part_labels(obj)
    if labels is None:
        raise DecompositionError(f"{obj.name} has lost its parts; decompose it again.")
    parts = np.unique(labels)
    identities = part_identities(obj, int(parts.max()) + 1)
    materials = part_materials(identities, [])
    collection = new_collection(obj, f"{obj.name} parts")
    bare = _copy(obj)
    implode(bare)
    clear(bare)
    pieces = []
    for part in parts.tolist():
        piece = _copy(bare)
        piece.name = piece.data.name = f"{obj.name} {identities[part].name}"
        _keep_faces(piece.data, labels == part, loose=not pieces)
        piece.color = materials[part].diffuse_color
        if not piece.data.materials:
            piece.data.materials.append(materials[part])
        collection.objects.link(piece)
        pieces.append(piece)
    _remove(bare)
    return pieces


def replace(obj: bpy.types.Object, piece: bpy.types.Object) -> None:
    """Remove an object whose parts were separated; its children go to one of them."""
    for child in obj.children:
        child.parent = piece
    _remove(obj)


def _copy(obj: bpy.types.Object) -> bpy.types.Object:
    copy = obj.copy()
    copy.data = obj.data.copy()
    return copy


def _remove(obj: bpy.types.Object) -> None:
    """Remove an object, and its mesh if nothing else has it."""
    mesh = obj.data
    bpy.data.objects.remove(obj)
    if mesh.users == 0:
        bpy.data.meshes.remove(mesh)


def _keep_faces(mesh: bpy.types.Mesh, kept: NDArray[np.bool_], loose: bool) -> None:
    """Delete the other faces of a mesh, and what is loose unless it is to stay."""
    bm = bmesh.new()
    try:
        bm.from_mesh(mesh)
        if not loose:
            vertices = [vertex for vertex in bm.verts if not vertex.link_faces]
            bmesh.ops.delete(bm, geom=vertices, context="VERTS")
        faces = [face for face, stays in zip(bm.faces, kept, strict=True) if not stays]
        bmesh.ops.delete(bm, geom=faces, context="FACES")
        bm.to_mesh(mesh)
    finally:
        bm.free()
