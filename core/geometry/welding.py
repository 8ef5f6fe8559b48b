"""Vertices at the same place: corners of triangles that meet there count as one."""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from ..steps.arrays import FloatArray, Int32Array, IntArray
from ..steps.progress import Progress, Steps

# Cells of the grid of places along each axis. They span more than two diagonals.
_CELLS = 2**21
_STRIDES = _CELLS ** np.arange(2, -1, -1)
# Vertices on either side of a border between cells, at most this share of a cell from
# it, are at the same place, too.
_BORDER = 0.1
# About the most vertices that are sorted in one step.
_MOST_VERTICES = 2**19


def welded(vertices: FloatArray, triangles: IntArray, step: float) -> Steps[Int32Array]:
    """Return the number of the place of each corner of triangles.

    Parameters
    ----------
    vertices : (V, 3) float
    triangles : (T, 3) int
    step : float
        Vertices in one cell of a grid of this width are at one place.

    Returns
    -------
    Steps of (T, 3) int32
        Places are numbered along the axes.
    """
    counts = np.zeros(len(vertices), dtype=np.int64)
    at_once = max(len(vertices), _MOST_VERTICES)
    for start in range(0, len(triangles), at_once):
        yield Progress("Surface", 0.1 * start / len(triangles))
        some = triangles[start : start + at_once]
        counts += np.bincount(some.ravel(), minlength=len(vertices))
    yield Progress("Surface", 0.1)
    center = counts @ vertices / triangles.size
    # One number sorts faster than three. Only vertices that no face uses lie outside
    # the grid.
    cells = np.zeros(len(vertices), dtype=np.int64)
    sides = np.zeros((3, len(vertices)), dtype=np.int8)
    for axis in range(3):
        yield Progress("Surface", 0.2 + 0.1 * axis)
        with np.errstate(over="ignore", invalid="ignore"):
            exact = (vertices[:, axis] - center[axis]) / step
            places = np.round(exact)
            rest = exact - places
        sides[axis][rest > 0.5 - _BORDER] = 1
        sides[axis][rest < _BORDER - 0.5] = -1
        places = np.clip(places + _CELLS // 2, 0, _CELLS - 1)
        cells += places.astype(np.int64) * _STRIDES[axis]
    yield Progress("Surface", 0.5)
    place_of = yield from _numbered(cells)
    one, other = yield from _across_borders(cells, sides)
    if len(one):
        place_of = _united(place_of, one, other)
    return place_of[triangles]


def distinct_points(points: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return different points, sorted, and which of them each point is.

    Takes less than half of the time of `numpy.unique` on rows.

    Parameters
    ----------
    points : (N, 3) float

    Returns
    -------
    places : (P, 3) float
    rows : (N,) int
        Row of `places` of each point.
    """
    order = np.lexsort(points.T[::-1])
    ordered = points[order]
    new = np.ones(len(points), dtype=bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    rows = np.empty(len(points), dtype=np.int64)
    rows[order] = np.cumsum(new) - 1
    return ordered[new], rows


def _numbered(cells: IntArray) -> Steps[Int32Array]:
    """Return the rank of each vertex's cell among all different ones, (V,)."""
    # Ranges of cells, of about as many vertices each, one after the other.
    n_ranges = -(-len(cells) // _MOST_VERTICES)
    few = np.sort(cells[:: max(len(cells) // (1000 * n_ranges), 1)])
    bounds = few[np.arange(1, n_ranges) * len(few) // n_ranges]
    range_of = np.searchsorted(bounds, cells, side="right")
    place_of, n_places = np.empty(len(cells), dtype=np.int32), 0
    for number in range(n_ranges):
        yield Progress("Surface", 0.5 + 0.4 * number / n_ranges)
        rows = np.flatnonzero(range_of == number)
        different, found = np.unique(cells[rows], return_inverse=True)
        place_of[rows] = found + n_places
        n_places += len(different)
    return place_of


def _across_borders(
    cells: IntArray, sides: NDArray[np.int8]
) -> Steps[tuple[IntArray, IntArray]]:
    """Return pairs of vertices in neighboring cells that meet at the border.

    Parameters
    ----------
    cells : (V,) int
    sides : (3, V) int
        Along each axis: 1 just below the upper border of the cell, -1 just above the
        lower one, else 0.

    Returns
    -------
    Steps of two (N,) int
        Rows of vertices. Rounding makes few such pairs, most shapes have none.
    """
    one, other = [], []
    for axes in product((False, True), repeat=3):
        if not any(axes):
            continue
        yield Progress("Surface", 0.9)
        rows = np.flatnonzero((sides[list(axes)] != 0).all(axis=0))
        # A border, edge or corner between cells has the number of its highest cell.
        borders = cells[rows] + _STRIDES[list(axes)] @ (sides[list(axes)][:, rows] > 0)
        order = np.argsort(borders, kind="stable")
        rows, borders = rows[order], borders[order]
        meet = (borders[1:] == borders[:-1]) & (cells[rows[1:]] != cells[rows[:-1]])
        one.append(rows[:-1][meet])
        other.append(rows[1:][meet])
    return np.concatenate(one), np.concatenate(other)


def _united(place_of: Int32Array, one: IntArray, other: IntArray) -> Int32Array:
    """Return places, (V,), numbered anew so that both vertices of a pair share one."""
    # SciPy would find components; enabling the extension loads meshes, but not SciPy.
    ends = place_of[np.stack([one, other])]
    lowest = np.arange(place_of.max() + 1, dtype=np.int32)
    while (lowest[ends[0]] != lowest[ends[1]]).any():
        lower = lowest[ends].min(axis=0)
        for end in ends:
            np.minimum.at(lowest, end, lower)
    is_first = lowest == np.arange(len(lowest))
    numbers = np.cumsum(is_first, dtype=np.int32) - 1
    return numbers[lowest[place_of]]
