"""Make an object of each part."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import bmesh
import bpy
from mathutils import Matrix

from ....core.steps.arrays import BoolArray
from ..cuts.whole_mesh import forget_whole
from ..homes import hand_over, new_collection
from ..hulls.hull_objects import erase_hulls
from ..hulls.rigid_bodies import soften
from ..mesh.corner_normals import give_back_normals, keep_normals
from ..mesh.known import face_areas
from ..stored.long_names import name_that_fits
from ..views.node_modifiers import discard_views, remove_views
from .erase import clear
from .materials import discard, discard_unused, none_missing
from .read import materials_of, parts_on


def separate(obj: bpy.types.Object, stays: bool) -> list[bpy.types.Object]:
    """Make an object of each part, and return them.

    Each is a copy of the object from before it was decomposed, with the faces of one
    part only. Modifiers, constraints, groups and attributes are copied, too. If the
    mesh has no materials, the copy gets the material of its part.

    Parameters
    ----------
    obj : Object
    stays : bool
        Whether the object stays. If not, the largest piece gets its children. Its hulls
        go with it: they stand for the whole.

    Raises
    ------
    DecompositionError
        If the object has no parts. Nothing is changed then, nor by any other error.
    """
    found = parts_on(obj)
    identities, own = found.identities, materials_of(obj, found)
    pieces: list[bpy.types.Object] = []
    with ExitStack() as on_error:
        collection = new_collection(obj, name_that_fits(obj.name, "parts"))
        on_error.callback(bpy.data.collections.remove, collection)
        on_error.callback(discard, pieces)
        with _bare_copy(obj) as bare:
            materials = none_missing(identities, own)  # Clear would discard new ones
            on_error.callback(discard_unused, materials)
            for part, identity in enumerate(identities):
                piece = _copy(bare)
                pieces.append(piece)
                name = name_that_fits(obj.name, identity.name)
                piece.name = piece.data.name = name
                _keep_faces(piece.data, found.labels == part, loose=part == 0)
                piece.color = materials[part].diffuse_color
                if not piece.data.materials:
                    piece.data.materials.append(materials[part])
                collection.objects.link(piece)
        if not stays:
            erase_hulls(obj)
        on_error.pop_all()
    if not stays:
        _replace(obj, max(pieces, key=lambda each: face_areas(each.data).sum()))
    return pieces


@contextmanager
def _bare_copy(obj: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """Lend a copy of an object without anything of ours."""
    bare = _copy(obj)
    try:
        soften(bare, ())
        remove_views(bare)
        clear(bare)
        forget_whole(bare.data)
        yield bare
    finally:
        discard([bare])


def _replace(obj: bpy.types.Object, piece: bpy.types.Object) -> None:
    """Remove an object whose parts were separated; `piece` gets its children."""
    for child in obj.children:
        hand_over(child, piece, Matrix())
    if obj.data.users == 1:
        forget_whole(obj.data)
    discard([obj])
    discard_views()


def _copy(obj: bpy.types.Object) -> bpy.types.Object:
    copy = obj.copy()
    copy.data = obj.data.copy()
    return copy


def _keep_faces(mesh: bpy.types.Mesh, kept: BoolArray, loose: bool) -> None:
    """Delete the other faces of a mesh, and loose vertices and edges unless `loose`."""
    bm = bmesh.new()
    try:
        bm.from_mesh(mesh)
        keep_normals(bm, mesh)
        if not loose:
            vertices = [vertex for vertex in bm.verts if not vertex.link_faces]
            bmesh.ops.delete(bm, geom=vertices, context="VERTS")
        faces = [face for face, stays in zip(bm.faces, kept, strict=True) if not stays]
        bmesh.ops.delete(bm, geom=faces, context="FACES")
        bm.to_mesh(mesh)
    finally:
        bm.free()
    give_back_normals(mesh)
