"""Where lines along the axes of coordinates cross the triangles of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.progress import Progress, Steps
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


@dataclass(frozen=True, eq=False)
class LineCrossings:
    """Finds the triangles that lines along the axes cross, see `line_crossings`.

    Attributes
    ----------
    low : (3, 2) float
        Where the grid across each axis begins.
    step : float
        Side of its cells.
    slopes : (10, 3 T) float
        Of the triangles three times, as lines along each axis see them.
    triangles : (N,) int
        The triangles over each cell of the three grids.
    starts : (C + 1,) int
        Where those of each cell start.
    """

    low: FloatArray
    step: float
    slopes: FloatArray
    triangles: IntArray
    starts: IntArray

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
        cells = np.floor((spots - self.low[axes]) / self.step).astype(np.int64)
        known = ((cells >= 0) & (cells < _CELLS)).all(axis=1)
        cell = np.where(known, _number_of(axes, cells[:, 0], cells[:, 1]), 0)
        counts = np.where(known, self.starts[cell + 1] - self.starts[cell], 0)
        line, rank = ranges(counts)
        triangle = self.triangles[self.starts[cell[line]] + rank]
        x0, y0, z0, bx, by, bz, cx, cy, cz, turns = self.slopes
        x, y = spots[line, 0] - x0[triangle], spots[line, 1] - y0[triangle]
        b = x * bx[triangle] + y * by[triangle]
        c = x * cx[triangle] + y * cy[triangle]
        hit = np.flatnonzero((b >= 0) & (c >= 0) & (b + c <= 1))
        triangle = triangle[hit]
        heights = z0[triangle] + b[hit] * bz[triangle] + c[hit] * cz[triangle]
        return line[hit], heights, turns[triangle].astype(np.int64)


def line_crossings(corners: FloatArray) -> Steps[LineCrossings]:
    """Return what finds the triangles that lines along the axes cross.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of the triangles, counter-clockwise seen from outside.
    """
    yield Progress("Solid", 0.0)
    corners = fragments_of(corners, _COARSE)[0].transpose(1, 2, 0).copy()
    low = corners.min(axis=(0, 2))[TURNS[:, :2]]
    step = float(np.ptp(corners, axis=(0, 2)).max() / _CELLS) or 1.0
    slopes, triangles, starts = [], [], []
    n_triangles, n_entries = corners.shape[2], 0
    for axis in range(3):
        yield Progress("Solid", axis / 3)
        turned = corners.take(TURNS[axis], axis=1)
        slopes.append(_slopes_of(turned))
        flat = (turned[:, :2] - low[axis, :, None]) / step
        found, first = _table(flat, slopes[-1][-1] != 0)
        triangles.append(found + axis * n_triangles)
        starts.append(first + n_entries)
        n_entries += len(found)
    return LineCrossings(
        low,
        step,
        np.concatenate(slopes, axis=1),
        np.concatenate(triangles),
        np.append(np.concatenate(starts), n_entries),
    )


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


def _table(flat: FloatArray, faces_lines: BoolArray) -> tuple[IntArray, IntArray]:
    """Return the triangles over each cell of a grid, and where those of each start.

    `flat` (3, 2, T) are their corners, in cells.
    """
    low, high = (
        np.clip(ends.astype(np.int64), 0, _CELLS - 1)
        for ends in (flat.min(axis=0), flat.max(axis=0))
    )
    widths = high - low + 1
    triangle, rank = ranges(np.where(faces_lines, widths[0] * widths[1], 0))
    column, row = np.divmod(rank, widths[1, triangle])
    column, row = column + low[0, triangle], row + low[1, triangle]
    cell = (column * _CELLS + row).astype(np.int16)  # NumPy sorts them by their digits
    order = np.argsort(cell, kind="stable")
    return triangle[order], np.searchsorted(
        cell[order], np.arange(_CELLS**2, dtype=np.int16)
    )


def _slopes_of(turned: FloatArray) -> FloatArray:
    """Return what tells where lines along z cross triangles (3, 3, T), (10, T).

    Three rows have the first corner. Then three for each other corner: how much its
    share of a point grows along x and y, and its z above that of the first corner. The
    last row is 1 where such a line enters the inside, −1 where it leaves it, 0 where it
    is in the plane.
    """
    a, b, c = turned[0], turned[1] - turned[0], turned[2] - turned[0]
    area = b[0] * c[1] - b[1] * c[0]
    faces = area != 0
    of_b = np.divide([c[1], -c[0]], area, out=np.zeros((2, len(area))), where=faces)
    of_c = np.divide([-b[1], b[0]], area, out=np.zeros((2, len(area))), where=faces)
    return np.concatenate([a, of_b, b[2:], of_c, c[2:], [-np.sign(area)]])
