"""Which triangles share an edge, and the sides of triangles along edges."""

from __future__ import annotations

from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ...steps.arrays import BoolArray, FloatArray, Int32Array, IntArray
from ...steps.memo import computed_once
from ...steps.progress import Progress, Steps, within
from ...steps.rows import blocks
from ..mesh import TriangleMesh

# About the most sides of triangles that are sorted in one step.
_MOST_SIDES = 2**20

Whole = TypeVar("Whole", np.int32, np.int64)


class Edges(NamedTuple):
    """The sides of all triangles, sorted by edge; coinciding vertices count as one.

    Attributes
    ----------
    sides : (3T,) int32
        Side 3t + i of triangle t runs from its corner i to the next one.
    first : (E,) int
        Place in `sides` of the first side of each edge.
    """

    sides: Int32Array
    first: IntArray

    @property
    def uses(self) -> IntArray:
        """Number of sides of each edge, (E,)."""
        uses = np.empty_like(self.first)  # np.diff would copy the places
        uses[:-1], uses[-1:] = self.first[1:], len(self.sides)
        uses -= self.first
        return uses

    @property
    def crowded(self) -> bool:
        """Whether some edge has more than two triangles: solids may touch there."""
        return bool((self.uses > 2).any())


@computed_once
def sort_edges(mesh: TriangleMesh) -> Steps[Edges]:
    """Sort the sides of a mesh's triangles by edge.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    Steps of Edges
    """
    tails = yield from within(mesh.welded_in_steps(), 0.0, 0.4)
    lower, higher = np.empty((2, tails.size), dtype=np.int32)
    for block in blocks(len(tails)):
        yield Progress("Surface", 0.4 + 0.1 * block.start / len(tails))
        heads = tails[block][:, [1, 2, 0]]
        some = slice(3 * block.start, 3 * block.stop)
        np.minimum(tails[block], heads, out=lower[some].reshape(-1, 3))
        np.maximum(tails[block], heads, out=higher[some].reshape(-1, 3))
    yield Progress("Surface", 0.5)
    n_ranges = -(-len(lower) // _MOST_SIDES)
    width = int(lower.max()) // n_ranges + 1
    range_of = np.empty(len(lower), dtype=np.int16)
    for block in blocks(len(lower)):
        yield Progress("Surface", 0.5)
        range_of[block] = lower[block] // width
    sides, new = np.empty(len(lower), dtype=np.int32), np.empty(len(lower), dtype=bool)
    start = 0
    for number in range(n_ranges):
        yield Progress("Surface", 0.5 + 0.5 * number / n_ranges)
        rows = np.flatnonzero(range_of == number).astype(np.int32)
        rows = rows[_order(higher[rows])]
        rows = rows[_order(lower[rows] - number * width)]
        end = start + len(rows)
        sides[start:end], new[start:end] = rows, True
        ends = np.stack([lower[rows], higher[rows]])
        new[start + 1 : end] = (ends[:, 1:] != ends[:, :-1]).any(axis=0)
        start = end
    yield Progress("Surface", 1.0)
    return Edges(sides, np.flatnonzero(new))


def shared_edges(mesh: TriangleMesh) -> Steps[tuple[Int32Array, Int32Array]]:
    """Return which polygons have a common edge.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    neighbors : (E, 2) int32
        Pairs of polygons.
    sides : (E,) int32
        The side along each edge, of a triangle of the second polygon.
    """
    edges = yield from within(sort_edges(mesh), 0.0, 0.5)
    n_sides = len(edges.sides)
    new = np.zeros(n_sides, dtype=bool)
    new[edges.first] = True
    found = []
    for start in range(0, n_sides, _MOST_SIDES):
        yield Progress("Surface", 0.5 + 0.5 * start / n_sides)
        sides = edges.sides[start : start + _MOST_SIDES + 1]
        owners = mesh.polygons[sides // 3].astype(np.int32)
        shared = owners[1:] != owners[:-1]
        shared &= ~new[start + 1 : start + len(sides)]
        pairs = np.stack([owners[:-1][shared], owners[1:][shared]], axis=1)
        found.append((pairs, sides[1:][shared]))
    yield Progress("Surface", 1.0)
    neighbors, along = zip(*found, strict=True)
    return np.concatenate(neighbors), np.concatenate(along)


def sides_forward(mesh: TriangleMesh) -> Steps[BoolArray]:
    """Return the sides that run from the lower to the higher place.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    Steps of (3T,) bool
        Numbered as in `Edges`.
    """
    corners = mesh.welded_triangles
    forward = np.empty(corners.size, dtype=bool)
    for rows in blocks(len(corners)):
        yield Progress("Surface", rows.start / len(corners))
        some, along = corners[rows], forward[3 * rows.start : 3 * rows.stop]
        np.less(some, some[:, [1, 2, 0]], out=along.reshape(-1, 3))
    return forward


def corner_of_sides(
    triangles: NDArray[Whole], sides: Int32Array, step: int
) -> NDArray[Whole]:
    """Return a corner of the triangle of each side, numbered as in `Edges`.

    Parameters
    ----------
    triangles : (T, 3) int32 or int64
        What stands at the corners of all triangles: vertices, or welded ones.
    sides : (...) int32
    step : int
        0 for the corner where a side starts, 1 for that where it ends, 2 for the one
        opposite.

    Returns
    -------
    (...) of the dtype of `triangles`
    """
    return triangles.ravel()[sides - sides % 3 + (sides + step) % 3]


def ends_of_sides(
    triangles: NDArray[Whole], sides: Int32Array
) -> tuple[NDArray[Whole], NDArray[Whole]]:
    """Return the corners (...) where sides of triangles start, and where they end.

    Parameters
    ----------
    triangles : (T, 3) int32 or int64
        As in `corner_of_sides`.
    sides : (...) int32
    """
    return corner_of_sides(triangles, sides, 0), corner_of_sides(triangles, sides, 1)


def places_of_sides(mesh: TriangleMesh, sides: Int32Array) -> FloatArray:
    """Return where sides of triangles start and end, and the corners opposite.

    Parameters
    ----------
    mesh : TriangleMesh
    sides : (...) int32

    Returns
    -------
    (3, ..., 3) float
    """
    corners = [corner_of_sides(mesh.triangles, sides, step) for step in range(3)]
    return mesh.vertices[np.stack(corners)]


def _order(numbers: Int32Array) -> Int32Array:
    """Return a stable order of numbers from 0. SciPy's counting sort beats NumPy's."""
    n_rows = len(numbers)
    ones = np.ones(n_rows, dtype=np.int8)
    starts = np.arange(n_rows + 1, dtype=np.int32)
    shape = n_rows, int(numbers.max(initial=0)) + 1  # SciPy finds none without rows
    rows = sparse.csr_array((ones, numbers, starts), shape)
    return rows.tocsc().indices
