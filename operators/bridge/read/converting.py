"""Make meshes of curves, texts, surfaces and metaballs.

Outlines are filled with faces. Flat shapes get small faces, so that seams can run
anywhere.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector

from ....core.errors import DecompositionError
from ..mesh.attributes import corner_vertices, read_ints, vertex_positions
from ..refusals import CONVERTIBLE

# What to do about an object that gives no faces, by its type.
_OUTLINES = (
    ", and no closed outline in one plane to fill with them; close its curves (Toggle"
    " Cyclic in Edit Mode) and flatten them, or give it an extrusion."
)
_ADVICE = {
    "CURVE": _OUTLINES,
    "SURFACE": _OUTLINES,
    "FONT": "; type letters in Edit Mode, and choose a font that has them.",
    "META": (
        "; metaballs whose names differ in a number alone share one surface, which"
        " belongs to the one without a number; choose that one."
    ),
}
# A shape is flat if its points are this close to a plane, as a share of its size.
_FLAT = 1e-4
# The longest edge of a flat shape, as a share of its diagonal.
_LONGEST = 1 / 60
# Edges are halved this often at most, to a thousandth of their length.
_MOST_HALVINGS = 10


@contextmanager
def lent_mesh(obj: bpy.types.Object) -> Iterator[bpy.types.Mesh]:
    """Give the mesh of an object, or one made of a curve that is removed at the end.

    Raises
    ------
    DecompositionError
        If no faces can be made of a curve.
    """
    if obj.type not in CONVERTIBLE:
        yield obj.data
        return
    mesh = converted(obj)
    try:
        yield mesh
    finally:
        bpy.data.meshes.remove(mesh)


def converted(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return a new mesh made of an object of another type.

    Raises
    ------
    DecompositionError
        If no faces can be made of it.
    """
    depsgraph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(obj.evaluated_get(depsgraph))
    if not mesh.polygons and obj.type == "CURVE":
        bpy.data.meshes.remove(mesh)
        mesh = _filled(obj)
    if not mesh.polygons:
        bpy.data.meshes.remove(mesh)
        raise DecompositionError(f"{obj.name} has no faces{_ADVICE[obj.type]}")
    mesh.materials.clear()
    places = vertex_positions(mesh).astype(np.float64)
    if _plane(places) is not None:
        _divide(mesh, float(np.linalg.norm(np.ptp(places, axis=0))))
    return mesh


def digest_of_shown(obj: bpy.types.Object) -> str:
    """Return a text that changes if `converted` would return another mesh.

    It comes from the mesh that Blender itself shows, which is at hand; filling and
    dividing take far longer.
    """
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    if mesh is None:  # as of a curve without splines
        return ""
    try:
        arrays = (
            vertex_positions(mesh),
            read_ints(mesh.edges, "vertices", 2),
            read_ints(mesh.polygons, "loop_total"),
            corner_vertices(mesh),
        )
    finally:
        evaluated.to_mesh_clear()
    digest = hashlib.sha1(str([array.shape for array in arrays]).encode())
    for array in arrays:
        digest.update(array.tobytes())
    return digest.hexdigest()


def _filled(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return the area inside the closed splines of a flat curve, as a mesh.

    The plane of the curve may be any; the mesh is empty if there is none.
    """
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
    """Return the turn of a plane through points (N, 3) into z = 0.

    None if they are in no plane, or all on a line.
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
    try:
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
    finally:
        bm.free()
