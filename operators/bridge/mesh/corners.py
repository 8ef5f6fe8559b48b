"""The triangles of a mesh, and the corners of its faces, which Blender calls loops.

A face has one corner for each of its vertices. The corners of face 0 come first, then
the corners of face 1, and so on.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, TypeAlias

import bpy
import numpy as np
from numpy.typing import NDArray

from .attributes import BoolArray, FloatArray, IntArray, read_floats, read_ints

Triangles: TypeAlias = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]
# What the triangles of a mesh follow from, and these, of the latest mesh.
_latest: tuple[tuple[FloatArray, IntArray, IntArray], Triangles] | None = None


def corner_vertices(mesh: bpy.types.Mesh) -> IntArray:
    """Return the vertex of each corner, (C,)."""
    return _of_corners(mesh, ".corner_vert", "vertex_index")


def triangles_of(
    mesh: bpy.types.Mesh,
) -> Triangles:
    """Return the vertices of a mesh, its triangles, and the face of each triangle.

    The arrays of the latest mesh are kept: Blender is slow to tell the triangles.

    Returns
    -------
    vertices : (V, 3) float
    triangles : (T, 3) int
    faces : (T,) int
    """
    global _latest
    mesh.calc_loop_triangles()
    places, corners = _positions(mesh), corner_vertices(mesh)
    faces = read_ints(mesh.loop_triangle_polygons, "value")
    if _latest is None or not all(
        map(np.array_equal, _latest[0], (places, corners, faces))
    ):
        arrays = (
            places.astype(np.float64),
            corners.astype(np.int64)[_corners_of_triangles(mesh, faces)],
            faces.astype(np.int64),
        )
        for array in arrays:
            array.flags.writeable = False  # a shape need not copy it
        _latest = (places, corners, faces), arrays
    return _latest[1]


def forget() -> None:
    """Free the memory of the latest triangles."""
    global _latest
    _latest = None


def _corners_of_triangles(mesh: bpy.types.Mesh, faces: IntArray) -> IntArray:
    """Return the corners of each triangle, (T, 3), from the face of each, (T,)."""
    if np.array_equal(faces, np.arange(len(mesh.polygons))):  # quicker than to ask
        return np.arange(3 * len(faces), dtype=np.int32).reshape(-1, 3)
    return read_ints(mesh.loop_triangles, "loops", 3)


def corner_edges(mesh: bpy.types.Mesh) -> IntArray:
    """Return the edge from each corner to the next one of its face, (C,)."""
    return _of_corners(mesh, ".corner_edge", "edge_index")


def corner_faces(mesh: bpy.types.Mesh) -> IntArray:
    """Return the face of each corner, (C,)."""
    starts = read_ints(mesh.polygons, "loop_start")  # a third faster than sizes
    sizes = np.diff(starts, append=len(mesh.loops))
    return np.repeat(np.arange(len(sizes), dtype=np.int32), sizes)


def edge_sides(
    mesh: bpy.types.Mesh, labels: NDArray[np.integer[Any]]
) -> tuple[NDArray[np.integer[Any]], NDArray[np.integer[Any]]]:
    """Return the lowest and the highest label of the faces at each edge.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    labels : (P,) int
        Label of each face, 0 or more.

    Returns
    -------
    lowest, highest : (E,) int
        `highest` is -1 for edges without faces.
    """
    edges, of_corners = corner_edges(mesh), labels[corner_faces(mesh)]
    lowest = np.full(len(mesh.edges), np.iinfo(labels.dtype).max, dtype=labels.dtype)
    highest = np.full(len(mesh.edges), -1, dtype=labels.dtype)
    np.minimum.at(lowest, edges, of_corners)
    np.maximum.at(highest, edges, of_corners)
    return lowest, highest


def boundary_edges(
    mesh: bpy.types.Mesh, labels: NDArray[np.integer[Any]], chosen: Sequence[int]
) -> BoolArray:
    """Return which edges lie between a chosen part and another part.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    labels : (P,) int
        Part of each face.
    chosen : sequence of int
        Parts.

    Returns
    -------
    (E,) bool
    """
    lowest, highest = edge_sides(mesh, labels)
    of_chosen = np.zeros(len(mesh.edges), dtype=bool)
    corners = np.isin(labels[corner_faces(mesh)], chosen)
    of_chosen[corner_edges(mesh)[corners]] = True
    return (highest >= 0) & (lowest != highest) & of_chosen


def vertices_by_label(
    mesh: bpy.types.Mesh, labels: IntArray, n_labels: int
) -> Iterator[IntArray]:
    """Yield the vertices of the faces of each label 0…K − 1.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    labels : (P,) int
        Label of each face, or of each vertex of a mesh without faces.
    n_labels : int
    """
    if getattr(mesh, "polygons", None):
        vertices, labels = corner_vertices(mesh), labels[corner_faces(mesh)]
    else:
        vertices = np.arange(len(labels), dtype=np.int32)
    n_vertices = int(vertices.max(initial=-1)) + 1
    for label in range(n_labels):
        members = np.zeros(n_vertices, dtype=bool)
        members[vertices[labels == label]] = True
        yield np.flatnonzero(members).astype(np.int32)


def _positions(mesh: bpy.types.Mesh) -> FloatArray:
    """Return the positions of the vertices, (V, 3)."""
    places = mesh.attributes.get("position")
    if places is None or mesh.is_editmode:  # attributes look empty in Edit Mode
        return read_floats(mesh.vertices, "co", 3)
    return read_floats(places.data, "vector", 3)  # a hundred times faster


def _of_corners(mesh: bpy.types.Mesh, attribute: str, name: str) -> IntArray:
    """Return an attribute of the corners, or the property with the same numbers."""
    corners = mesh.attributes.get(attribute)
    if corners is None or mesh.is_editmode:  # attributes look empty in Edit Mode
        return read_ints(mesh.loops, name)
    return read_ints(corners.data, "value")  # a hundred times faster
