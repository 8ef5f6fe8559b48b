"""Where lines along the axes of coordinates cross the triangles of a mesh."""

from __future__ import annotations

import numpy as np

from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.rows import ranges
from .fragments import fragments_of

# For lines along each axis: the two coordinates across them, then the one along them.
TURNS = np.array([[1, 2, 0], [2, 0, 1], [0, 1, 2]])
# Number of cells of the table of triangles along each side.
_CELLS = 96
# Longest edge of the triangles in the table.
_COARSE = 0.3


def as_seen(places: FloatArray) -> FloatArray:
    """Return places (..., 3) as lines along each axis see them, (3, ..., 3).

    Coordinates are in the order of `TURNS`.
    """
    return np.stack([places[..., turn] for turn in TURNS])


class LineCrossings:
    """Finds the triangles that lines along the axes cross.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of the triangles, counter-clockwise seen from outside.
    """

    def __init__(self, corners: FloatArray) -> None:
        corners = fragments_of(corners, _COARSE)[0]
        self._low = corners.min(axis=(0, 1))[TURNS[:, :2]]
        self._step = np.ptp(corners, axis=(0, 1)).max() / _CELLS or 1.0
        # The triangles three times, as lines along each axis see them.
        axes = np.repeat(np.arange(3), len(corners))
        turned = as_seen(corners).reshape(-1, 3, 3)
        self._slopes = _slopes_of(turned)
        self._triangles, self._starts = self._table(axes, turned)

    def _table(self, axes: IntArray, turned: FloatArray) -> tuple[IntArray, IntArray]:
        """Return the triangles over each cell of three grids, and where they start."""
        flat = (turned[..., :2] - self._low[axes, None]) / self._step
        low, high = (
            np.clip(ends.astype(np.int64), 0, _CELLS - 1)
            for ends in (flat.min(axis=1), flat.max(axis=1))
        )
        widths = high - low + 1
        faces_lines = self._slopes[-1] != 0
        counts = np.where(faces_lines, widths.prod(axis=1), 0)
        triangle, rank = ranges(counts)
        column, row = np.divmod(rank, widths[triangle, 1])
        column, row = column + low[triangle, 0], row + low[triangle, 1]
        cell = _number_of(axes[triangle], column, row)
        order = np.argsort(cell, kind="stable")
        starts = np.searchsorted(cell[order], np.arange(3 * _CELLS**2 + 1))
        return triangle[order], starts

    def of(
        self, axes: IntArray, spots: FloatArray
    ) -> tuple[IntArray, FloatArray, IntArray]:
        """Return the crossings of lines with triangles.

        Parameters
        ----------
        axes : (L,) int
            Axis that each line runs along.
        spots : (L, 2) float
            The coordinates across, in the order of `TURNS`.

        Returns
        -------
        line : (C,) int
            Row of the line.
        heights : (C,) float
            Coordinate along the line.
        turns : (C,) int
            1 where the line enters the inside, −1 where it leaves it.
        """
        cells = np.floor((spots - self._low[axes]) / self._step).astype(np.int64)
        known = ((cells >= 0) & (cells < _CELLS)).all(axis=1)
        cell = np.where(known, _number_of(axes, cells[:, 0], cells[:, 1]), 0)
        counts = np.where(known, self._starts[cell + 1] - self._starts[cell], 0)
        line, rank = ranges(counts)
        triangle = self._triangles[self._starts[cell[line]] + rank]
        x0, y0, z0, bx, by, bz, cx, cy, cz, turns = self._slopes
        x, y = spots[line, 0] - x0[triangle], spots[line, 1] - y0[triangle]
        b = x * bx[triangle] + y * by[triangle]
        c = x * cx[triangle] + y * cy[triangle]
        hit = np.flatnonzero((b >= 0) & (c >= 0) & (b + c <= 1))
        triangle = triangle[hit]
        heights = z0[triangle] + b[hit] * bz[triangle] + c[hit] * cz[triangle]
        return line[hit], heights, turns[triangle].astype(np.int64)


def in_order(
    line: IntArray, heights: FloatArray, turns: IntArray
) -> tuple[
    IntArray,
    FloatArray,
    IntArray,
    BoolArray,
    IntArray,
]:
    """Sort crossings of lines and a surface by line and height, and count them.

    Parameters
    ----------
    line : (C,) int
        Row of the line.
    heights : (C,) float
        Coordinate along the line.
    turns : (C,) int
        1 where the line enters the inside, −1 where it leaves it.

    Returns
    -------
    line, heights, turns : (C,) int, float and int
        Sorted.
    first : (C,) bool
        Which are the first on their line.
    depths : (C,) int
        How many more times the line has entered than left from there on.
    """
    order = np.lexsort((heights, line))
    line, heights, turns = line[order], heights[order], turns[order]
    first = np.r_[True, line[1:] != line[:-1]][: len(line)]
    starts = np.maximum.accumulate(np.where(first, np.arange(len(line)), 0))
    total = np.cumsum(turns)
    return line, heights, turns, first, total - (total - turns)[starts]


def _number_of(axes: IntArray, columns: IntArray, rows: IntArray) -> IntArray:
    """Return the numbers of cells of the grids across the axes."""
    return (axes * _CELLS + columns) * _CELLS + rows


def _slopes_of(turned: FloatArray) -> FloatArray:
    """Return what tells where lines along z cross triangles (T, 3, 3), (10, T).

    Three rows have the first corner. Then three for each other corner: how much its
    share of a point grows along x and y, and its z above that of the first corner. The
    last row is 1 where such a line enters the inside, −1 where it leaves it, 0 where it
    is in the plane.
    """
    a, b, c = np.moveaxis(turned, 1, 0)
    a, b, c = a.T, (b - a).T, (c - a).T
    area = b[0] * c[1] - b[1] * c[0]
    faces = area != 0
    of_b = np.divide([c[1], -c[0]], area, out=np.zeros((2, len(area))), where=faces)
    of_c = np.divide([-b[1], b[0]], area, out=np.zeros((2, len(area))), where=faces)
    return np.concatenate([a, of_b, b[2:], of_c, c[2:], [-np.sign(area)]])
