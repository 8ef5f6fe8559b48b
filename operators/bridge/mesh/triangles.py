"""How Blender cuts faces into triangles: told quickly for those that are plain quads.

Blender tells the corners of triangles one by one, which takes 0.1 s for a million. But
it cuts a quad between its first and third corner, unless that line is not inside. Only
where that is not plain to see, it has to be asked.
"""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from numpy.typing import NDArray

from .attributes import FloatArray, IntArray, read_ints

# Quads that are looked at together: their arrays fit into the cache.
_BLOCK = 2**14
# The second and fourth corner are plainly beside the line, if they are this far from
# it, as a share of the largest coordinate. Blender rounds to a tenth of this.
_BESIDE = 1e-5
# Both halves plainly face the same way: the cosine between them is above this.
_ALIKE = 0.1
# To ask for single triangles is quicker, if they are at most this share of all.
_FEW = 0.05


def corners_of_triangles(
    mesh: bpy.types.Mesh, faces: IntArray, places: FloatArray, corners: IntArray
) -> IntArray:
    """Return the corners of each triangle of a mesh, as Blender cuts its faces.

    Parameters
    ----------
    mesh : bpy.types.Mesh
        With its triangles made.
    faces : (T,) int32
        The face of each triangle.
    places : (V, 3) float32
        The vertices.
    corners : (C,) int32
        The vertex of each corner.

    Returns
    -------
    (T, 3) int32
    """
    counts = np.bincount(faces, minlength=len(mesh.polygons))
    starts = np.cumsum(counts + 2) - counts - 2
    if len(faces) == 0 or starts[-1] + counts[-1] + 2 != len(corners):
        return _all_asked(mesh)
    asked = counts > 2
    quads = np.flatnonzero(counts == 2)
    columns = np.ascontiguousarray(places.T)
    least = _BESIDE * np.abs(columns).max()
    with np.errstate(over="ignore", invalid="ignore"):  # such quads are not plain
        for start in range(0, len(quads), _BLOCK):
            block = quads[start : start + _BLOCK]
            at = corners[starts[block] + np.arange(4)[:, None]]
            asked[block] = ~_plain(np.take(columns, at, axis=1), least)
    rows = np.flatnonzero(asked[faces]) if asked.any() else quads[:0]
    if len(rows) > _FEW * len(faces):
        return _all_asked(mesh)
    # The triangles of a plain quad share its first corner.
    found = np.empty((len(faces), 3), dtype=np.int32)
    found[:, 0] = np.repeat(starts, counts)
    found[:, 1] = np.arange(1, len(faces) + 1) + np.repeat(
        starts - np.cumsum(counts) + counts, counts
    )
    found[:, 2] = found[:, 1] + 1
    triangles = mesh.loop_triangles
    for row in rows.tolist():
        found[row] = triangles[row].loops[:]
    return found


def _plain(quads: FloatArray, least: float) -> NDArray[np.bool_]:
    """Return which quads (3, 4, Q) are plainly convex along their first diagonal, (Q,).

    `least` is how far its other corners have to be from it.
    """
    two, across, four = np.moveaxis(quads[:, 1:] - quads[:, :1], 1, 0)
    before, after = _cross(two, across), _cross(across, four)
    areas, areas_after = _dot(before, before), _dot(after, after)
    smaller = np.minimum(areas, areas_after)
    plain: NDArray[np.bool_] = smaller > np.square(least) * _dot(across, across)
    return plain & (
        _dot(before, after) > _ALIKE * np.sqrt(areas) * np.sqrt(areas_after)
    )


def _cross(one: FloatArray, other: FloatArray) -> tuple[FloatArray, ...]:
    """Return the three columns of the cross products of vectors, both (3, Q)."""
    (ax, ay, az), (bx, by, bz) = one, other
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


def _dot(one: Sequence[FloatArray], other: Sequence[FloatArray]) -> FloatArray:
    """Return the dot products (Q,) of vectors in three columns."""
    (ax, ay, az), (bx, by, bz) = one, other
    return ax * bx + ay * by + az * bz


def _all_asked(mesh: bpy.types.Mesh) -> IntArray:
    """Return the corners of all triangles, (T, 3), as Blender tells them."""
    return read_ints(mesh.loop_triangles, "loops", 3)
