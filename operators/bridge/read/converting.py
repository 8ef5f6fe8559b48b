"""Curves, texts, surfaces and metaballs as meshes: made on a copy.

Outlines are filled with faces; whatever is flat gets small ones, for seams to follow.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector

from ....core.errors import DecompositionError

# Objects that Blender makes meshes of.
CONVERTIBLE = {"CURVE", "SURFACE", "META", "FONT"}
# Points this far from a plane lie in it, and the longest edges in it, in diagonals.
_FLAT = 1e-4
_LONGEST = 1 / 60
# Times that edges are halved at most: their length falls to a thousandth.
_MOST_HALVINGS = 10
# Custom property of objects that carry the parts of others.
_TAG = "wcd_parts_of"


@contextmanager
def mesh_of(obj: bpy.types.Object) -> Iterator[bpy.types.Mesh]:
    """Yield the mesh of an object, one made for the moment if it is of another type.

    Raises
    ------
    DecompositionError
        If no faces can be made of it.
    """
    if obj.type not in CONVERTIBLE:
        yield obj.data
        return
    mesh = converted(obj)
    try:
        yield mesh
    finally:
        bpy.data.meshes.remove(mesh)


def carrier_of(obj: bpy.types.Object) -> bpy.types.Object:
    """Return what parts are written to: the object, or a new mesh object beside it.

    The latter is the active child of the former and takes the place of an earlier one.
    """
    if obj.type not in CONVERTIBLE:
        return obj
    mesh = converted(obj)
    for child in [child for child in obj.children if _TAG in child]:
        former = child.data
        bpy.data.objects.remove(child)
        if former.users == 0:
            bpy.data.meshes.remove(former)
    mesh.name = f"{obj.name} parts"
    carrier = bpy.data.objects.new(mesh.name, mesh)
    carrier[_TAG] = obj.name
    carrier.parent = obj
    for collection in obj.users_collection:
        collection.objects.link(carrier)
    bpy.context.view_layer.update()
    shown = bpy.context.view_layer.objects  # others may be since it was begun
    if carrier.name in shown:
        obj.select_set(False)
        carrier.select_set(True)
        shown.active = carrier
    return carrier


def converted(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return a new mesh of an object that is none; errors are those of `mesh_of`."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(obj.evaluated_get(depsgraph))
    if not mesh.polygons and obj.type == "CURVE":
        bpy.data.meshes.remove(mesh)
        mesh = _filled(obj)
    if not mesh.polygons:
        bpy.data.meshes.remove(mesh)
        raise DecompositionError(
            f"{obj.name} has no faces, and no closed outline in one plane to fill with"
            " them; close its curves (Toggle Cyclic in Edit Mode) and flatten them, or"
            " give it an extrusion."
        )
    mesh.materials.clear()
    places = np.array([vertex.co for vertex in mesh.vertices])
    if _plane(places) is not None:
        _divide(mesh, float(np.linalg.norm(np.ptp(places, axis=0))))
    return mesh


def _filled(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return what the closed splines of a flat curve enclose, turned any way."""
    curve = obj.data.copy()
    for spline in [spline for spline in curve.splines if not spline.use_cyclic_u]:
        curve.splines.remove(spline)
    places = [
        point.co[:3]
        for spline in curve.splines
        for point in (*spline.points, *spline.bezier_points)
    ]
    upright = _plane(np.array(places).reshape(-1, 3))
    stand_in = bpy.data.objects.new("outline", curve)
    try:
        if upright is None:
            return bpy.data.meshes.new("outline")
        curve.transform(upright)
        curve.dimensions, curve.fill_mode = "2D", "BOTH"
        mesh = bpy.data.meshes.new_from_object(stand_in)
        mesh.transform(upright.inverted())
        return mesh
    finally:
        bpy.data.objects.remove(stand_in)
        bpy.data.curves.remove(curve)


def _plane(places: np.ndarray) -> Matrix | None:
    """Return what turns places (N, 3) in a plane into z = 0, None if they are in none.

    Those in a line are in none.
    """
    if len(places) < 3:
        return None
    center = places.mean(axis=0)
    _, widths, axes = np.linalg.svd(places - center, full_matrices=False)
    if widths[1] <= _FLAT * widths[0] or widths[2] > _FLAT * widths[0]:
        return None
    turn = Vector(axes[2]).rotation_difference(Vector((0, 0, 1))).to_matrix().to_4x4()
    return turn @ Matrix.Translation(-Vector(center))


def _divide(mesh: bpy.types.Mesh, diagonal: float) -> None:
    """Cut the faces of a flat mesh into small triangles."""
    bm = bmesh.new()
    bm.from_mesh(mesh)
    bmesh.ops.remove_doubles(bm, verts=bm.verts, dist=1e-6 * diagonal)
    bmesh.ops.triangulate(bm, faces=bm.faces)
    for _ in range(_MOST_HALVINGS):
        bmesh.ops.beautify_fill(bm, faces=bm.faces, edges=bm.edges)
        long = [e for e in bm.edges if e.calc_length() > _LONGEST * diagonal]
        if not long:
            break
        bmesh.ops.subdivide_edges(bm, edges=long, cuts=1)
        bmesh.ops.triangulate(bm, faces=bm.faces)
    bm.to_mesh(mesh)
    bm.free()
