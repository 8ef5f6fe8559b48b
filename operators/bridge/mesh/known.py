"""What Blender is slow to tell of a mesh, kept for the latest that was read.

It is found again by content, so that no change goes unnoticed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import bpy
import numpy as np
from numpy.typing import NDArray

from ....core.steps.arrays import Float32Array, FloatArray, Int32Array, IntArray
from ....core.steps.progress import Progress, Steps, as_steps, run
from .attributes import corner_vertices, read_floats, read_ints, vertex_positions
from .triangles import Asked, ask, cut_in_steps

Triangles: TypeAlias = tuple[FloatArray, IntArray, IntArray]


class Known(NamedTuple):
    """What is known of a mesh: what all else follows from, and what was asked.

    Attributes
    ----------
    places : (V, 3) float32
        Its vertices.
    corners : (C,) int32
        The vertex of each corner.
    of_triangles : (T,) int32
        The face of each triangle.
    triangles : Triangles
    asked : dict
        The arrays of `SLOW` that were read already.
    ahead : dict
        What `by_label.read_ahead` keeps until it is asked for.
    """

    places: Float32Array
    corners: Int32Array
    of_triangles: Int32Array
    triangles: Triangles
    asked: dict[str, NDArray[Any]]
    ahead: dict[tuple[bytes, int], Any]

    def is_of(self, mesh: bpy.types.Mesh, places: Float32Array | None = None) -> bool:
        """Return whether a mesh has these vertices and faces.

        Its vertices are read if their `places` are not given.
        """
        sizes = len(mesh.vertices), len(mesh.loops)
        if sizes != (len(self.places), len(self.corners)):
            return False  # Blender need not find the triangles
        places = vertex_positions(mesh) if places is None else places
        if not np.array_equal(self.places, places):
            return False
        if not np.array_equal(self.corners, corner_vertices(mesh)):
            return False
        return np.array_equal(self.of_triangles, _faces_of_triangles(mesh))

    def read(self, mesh: bpy.types.Mesh, name: str) -> NDArray[Any]:
        """Return an array of `SLOW`, read from the mesh if it was not asked before."""
        if name not in self.asked:
            self.asked[name] = SLOW[name](mesh)
            self.asked[name].flags.writeable = False
        return self.asked[name]


_latest: Known | None = None


def triangles_of(mesh: bpy.types.Mesh) -> Triangles:
    """Return at once what `triangles_in_steps` returns."""
    return run(triangles_in_steps(mesh))


def triangles_in_steps(
    mesh: bpy.types.Mesh, places: Float32Array | None = None
) -> Steps[Triangles]:
    """Return the vertices of a mesh, its triangles, and the face of each triangle.

    The mesh is read at once, so that it may change before the steps are done.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    places : (V, 3) float32, optional
        Its `vertex_positions`, if they were read already.

    Returns
    -------
    vertices : (V, 3) float
    triangles : (T, 3) int
    faces : (T,) int
    """
    places = vertex_positions(mesh) if places is None else places
    if _latest is not None and _latest.is_of(mesh, places):
        return as_steps(_latest.triangles)
    faces, corners = _faces_of_triangles(mesh), corner_vertices(mesh)
    return _understood(faces, places, corners, ask(mesh, faces))


def _understood(
    faces: Int32Array, places: Float32Array, corners: Int32Array, asked: Asked
) -> Steps[Triangles]:
    """Return the triangles of a mesh from what was read, and keep them."""
    global _latest
    triangles = yield from cut_in_steps(asked, places, corners)
    yield Progress("Surface", 0.0)
    vertices = places.astype(np.float64)
    yield Progress("Surface", 0.0)
    arrays = vertices, triangles, faces.astype(np.int64)
    for array in arrays:
        array.flags.writeable = False  # a shape need not copy it
    _latest = Known(places, corners, faces, arrays, {}, {})
    return _latest.triangles


def face_areas(mesh: bpy.types.Mesh) -> Float32Array:
    """Return the area of each face, (P,)."""
    return _read(mesh, "areas")


def face_centers(mesh: bpy.types.Mesh) -> Float32Array:
    """Return the center of each face, (P, 3)."""
    return _read(mesh, "centers")


def corner_faces(mesh: bpy.types.Mesh) -> Int32Array:
    """Return the face of each corner, (C,)."""
    return _read(mesh, "corner_faces")


def latest_of(mesh: bpy.types.Mesh) -> Known | None:
    """Return what is known of a mesh if it is the latest, None if not.

    It is the same object until another mesh is read, or this one has changed.
    """
    return _latest if _latest is not None and _latest.is_of(mesh) else None


def forget() -> None:
    """Free the memory of the latest mesh."""
    global _latest
    _latest = None


def _read(mesh: bpy.types.Mesh, name: str) -> NDArray[Any]:
    """Return an array of `SLOW`, which is kept for the next time if it may be."""
    known = latest_of(mesh)
    return SLOW[name](mesh) if known is None else known.read(mesh, name)


def _corner_faces(mesh: bpy.types.Mesh) -> Int32Array:
    """Return the face of each corner, (C,)."""
    starts = read_ints(mesh.polygons, "loop_start")  # a third faster than sizes
    sizes = np.diff(starts, append=len(mesh.loops))
    return np.repeat(np.arange(len(sizes), dtype=np.int32), sizes)


def _faces_of_triangles(mesh: bpy.types.Mesh) -> Int32Array:
    """Return the face of each triangle, (T,)."""
    mesh.calc_loop_triangles()
    return read_ints(mesh.loop_triangle_polygons, "value")


def finite(figures: Float32Array) -> Float32Array:
    """Return figures with 0 for what single precision cannot hold.

    The areas of faces longer than some 1e10 cannot be held.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        known = np.isfinite(figures.sum())  # quicker than to ask each
    return figures if known else np.nan_to_num(figures, posinf=0.0, neginf=0.0)


# What takes a while for a large mesh, by the names under which it is kept.
SLOW: dict[str, Callable[[bpy.types.Mesh], NDArray[Any]]] = {
    "areas": lambda mesh: finite(read_floats(mesh.polygons, "area")),
    "centers": lambda mesh: finite(read_floats(mesh.polygons, "center", 3)),
    "corner_faces": _corner_faces,
}
