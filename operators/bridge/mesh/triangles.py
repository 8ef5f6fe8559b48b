"""How Blender cuts faces into triangles: told quickly for those that are plain quads.

Blender tells the corners of triangles one by one, which takes 0.1 s for a million. But
it cuts a quad between its first and third corner, unless that line is not inside. Only
where that is not plain to see, it has to be asked.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import bpy
import numpy as np
from numpy.typing import NDArray

from ....core.steps.progress import Progress, Steps
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
_READING = Progress("Surface", 0.0)


class Answers(NamedTuple):
    """What Blender was asked of a mesh; how it cuts the other faces follows from it.

    Attributes
    ----------
    counts : (P,) int
        Number of triangles of each face.
    rows : (R,) int
        Triangles that Blender was asked for.
    corners : (R, 3) int32
        Their corners.
    """

    counts: NDArray[np.int64]
    rows: NDArray[np.int64]
    corners: IntArray


def ask(
    mesh: bpy.types.Mesh, faces: IntArray, places: FloatArray, corners: IntArray
) -> Answers:
    """Ask Blender for the triangles that have to be asked for.

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
    Answers
    """
    counts = np.bincount(faces, minlength=len(mesh.polygons))
    if len(faces) == 0 or counts.sum() + 2 * len(counts) != len(corners):
        return _all_asked(mesh, counts)
    asked = counts > 2
    quads = np.flatnonzero(counts == 2)
    if len(quads):
        firsts = _first_corners(counts)[quads]
        asked[quads] = ~_are_plain(firsts, places, corners)
    rows = np.flatnonzero(asked[faces]) if asked.any() else quads[:0]
    if len(rows) > _FEW * len(faces):
        return _all_asked(mesh, counts)
    triangles = mesh.loop_triangles
    told = [triangles[row].loops[:] for row in rows.tolist()]
    return Answers(counts, rows, np.array(told, dtype=np.int32).reshape(-1, 3))


def corners_of_triangles(answers: Answers) -> Steps[IntArray]:
    """Return the corners of each triangle of a mesh, as Blender cuts its faces.

    Parameters
    ----------
    answers : Answers
        The mesh itself may have changed since.

    Returns
    -------
    Steps of (T, 3) int32
    """
    counts = answers.counts
    n_triangles = int(counts.sum())
    if len(answers.rows) == n_triangles:
        return answers.corners
    yield _READING
    # The triangles of a plain quad share its first corner.
    found = np.empty((n_triangles, 3), dtype=np.int32)
    starts = _first_corners(counts)
    found[:, 0] = np.repeat(starts, counts)
    yield _READING
    found[:, 1] = np.arange(1, n_triangles + 1) + np.repeat(
        starts - np.cumsum(counts) + counts, counts
    )
    found[:, 2] = found[:, 1] + 1
    found[answers.rows] = answers.corners
    return found


def _first_corners(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the first corner of each face, (P,), from its number of triangles."""
    sizes = counts + 2
    firsts: NDArray[np.int64] = np.cumsum(sizes)
    firsts -= sizes
    return firsts


def _are_plain(
    firsts: NDArray[np.int64], places: FloatArray, corners: IntArray
) -> NDArray[np.bool_]:
    """Return which quads are `_plain`, (Q,), from the first corner of each."""
    columns = np.ascontiguousarray(places.T)
    least = _BESIDE * np.abs(columns).max()
    plain = np.empty(len(firsts), dtype=bool)
    with np.errstate(over="ignore", invalid="ignore"):  # such quads are not plain
        for start in range(0, len(firsts), _BLOCK):
            block = slice(start, start + _BLOCK)
            at = corners[firsts[block] + np.arange(4)[:, None]]
            plain[block] = _plain(np.take(columns, at, axis=1), least)
    return plain


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


def _all_asked(mesh: bpy.types.Mesh, counts: NDArray[np.int64]) -> Answers:
    """Return the corners of all triangles, as Blender tells them."""
    corners = read_ints(mesh.loop_triangles, "loops", 3)
    return Answers(counts, np.arange(len(corners)), corners)
