"""Triangles without area: they bound nothing, and part no others.

Booleans leave them behind. Most have two corners at one place: they are collapsed, and
their two other sides are one edge.
"""

from __future__ import annotations

import numpy as np

from ..geometry.graphs.edges import Edges, sort_edges
from ..geometry.mesh import SAME_PLACE, TriangleMesh
from ..steps.arrays import BoolArray, Int32Array, IntArray
from ..steps.memo import computed_once
from ..steps.progress import Progress, Steps, within
from ..steps.rows import blocks


def are_thin(mesh: TriangleMesh, rows: IntArray) -> Steps[bool]:
    """Return whether some triangles all have their corners on one line.

    They have if the height above the longest side counts as one place.

    Parameters
    ----------
    mesh : TriangleMesh
    rows : (R,) int
        Some of its triangles.

    Returns
    -------
    Steps of bool
    """
    yield from within(mesh.normals_in_steps(), 0.0, 0.5)
    for some in blocks(len(rows)):
        yield Progress("Surface", 0.5)
        if not _is_thin(mesh, rows[some]).all():
            return False
    return True


@computed_once
def solid_edges(mesh: TriangleMesh) -> Steps[tuple[Edges, BoolArray]]:
    """Return the edges of a mesh without collapsed triangles.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    edges : Edges
        Those of `sort_edges` if no triangle is left out.
    left_out : (T,) bool
        The collapsed triangles.
    """
    edges = yield from within(sort_edges(mesh), 0.0, 0.6)
    left_out = yield from within(_collapsed(mesh), 0.6, 0.8)
    if left_out.any():
        edges = yield from within(_without(edges, left_out), 0.8, 1.0)
    return edges, left_out


def hosts(mesh: TriangleMesh, left_out: BoolArray) -> Steps[Int32Array]:
    """Return pairs of a triangle that was left out and another one at a corner of it.

    There is one pair for each, so that no shells are connected through them. The other
    one was left out, too, only if nothing else is there.

    Parameters
    ----------
    mesh : TriangleMesh
    left_out : (T,) bool

    Returns
    -------
    Steps of (N, 2) int32
    """
    places, rows = mesh.welded_triangles, np.flatnonzero(left_out).astype(np.int32)
    owner = np.empty(int(places.max()) + 1, dtype=np.int32)
    owner[places[rows]] = rows[:, None]
    for some in blocks(len(places)):
        yield Progress("Surface", some.start / len(places))
        kept = some.start + np.flatnonzero(~left_out[some])
        owner[places[kept]] = kept[:, None]
    yield Progress("Surface", 1.0)
    found = owner[places[rows]]
    columns = left_out[found].argmin(axis=1)  # the first that was not, or column 0
    return np.stack([rows, found[np.arange(len(rows)), columns]], axis=1)


def _collapsed(mesh: TriangleMesh) -> Steps[BoolArray]:
    """Return the triangles (T,) that have two corners at one place, or all three."""
    places = yield from within(mesh.welded_in_steps(), 0.0, 0.5)
    collapsed = np.empty(len(places), dtype=bool)
    for rows in blocks(len(places)):
        yield Progress("Surface", 0.5 + 0.5 * rows.start / len(places))
        a, b, c = places[rows].T
        collapsed[rows] = (a == b) | (b == c) | (c == a)
    return collapsed


def _without(edges: Edges, left_out: BoolArray) -> Steps[Edges]:
    """Return edges without some triangles (T,); the others keep their numbers."""
    kept = np.empty(len(edges.sides), dtype=bool)
    for rows in blocks(len(kept)):
        yield Progress("Surface", 0.6 * rows.start / len(kept))
        kept[rows] = ~left_out[edges.sides[rows] // 3]
    before = np.zeros(len(kept) + 1, dtype=np.int64)
    np.cumsum(kept, out=before[1:])
    yield Progress("Surface", 0.8)
    first = before[edges.first]
    used = np.append(first[1:], before[-1]) > first
    yield Progress("Surface", 0.9)
    return Edges(edges.sides[kept], first[used])


def _is_thin(mesh: TriangleMesh, rows: IntArray) -> BoolArray:
    """Return whether each of some triangles (R,) has its corners on one line."""
    a, b, c = (mesh.vertices[column] for column in mesh.triangles[rows].T)
    squares = [(side * side).sum(axis=1) for side in (a - b, b - c, c - a)]
    longest = np.sqrt(np.maximum.reduce(squares))
    return 2 * mesh.areas[rows] <= SAME_PLACE * mesh.diagonal * longest
