"""Chords: segments of axis-parallel lines that run through the inside of a shape.

Each chord stands for the volume of the prism around it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.frames import cross_2d

# Number of lines along the longest side of the bounding box.
_LINES = 40


def chords_along(
    corners: NDArray[np.float64], axis: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the chords along an axis, split into short ones.

    Lines form a square grid. A line is inside where it has entered more triangles
    than it has left. No chord is longer than the distance between two lines.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of the triangles, counter-clockwise seen from outside.
    axis : int
        0, 1 or 2: the lines are parallel to X, Y or Z.

    Returns
    -------
    centers : (C, 3) float
        Middle of each chord.
    volumes : (C,) float
        Volume of the prism around each chord. Their sum estimates the volume inside.
    """
    sides = [(axis + 1) % 3, (axis + 2) % 3]
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    step = float((high - low).max()) / _LINES
    lines = [np.arange(low[side] + 0.457 * step, high[side], step) for side in sides]
    line, heights, turns = _crossings(corners, axis, lines)
    order = np.lexsort((heights, line))
    line, heights, turns = line[order], heights[order], turns[order]
    first = np.r_[True, line[1:] != line[:-1]][: len(line)]
    starts = np.maximum.accumulate(np.where(first, np.arange(len(line)), 0))
    total = np.cumsum(turns)
    depths = total - (total - turns)[starts]
    inside = np.flatnonzero((depths[:-1] > 0) & ~first[1:])
    lengths = heights[inside + 1] - heights[inside]
    n_pieces = np.ceil(lengths / step).astype(np.int64)
    chord = np.repeat(np.arange(len(inside)), n_pieces)
    rank = np.arange(len(chord)) - np.repeat(np.cumsum(n_pieces) - n_pieces, n_pieces)
    shares = (rank + 0.5) / n_pieces[chord]
    centers = np.empty((len(chord), 3))
    centers[:, axis] = heights[inside][chord] + shares * lengths[chord]
    column, row = np.divmod(line[inside][chord], len(lines[1]))
    centers[:, sides[0]], centers[:, sides[1]] = lines[0][column], lines[1][row]
    return centers, (lengths / np.maximum(n_pieces, 1))[chord] * step**2


def _crossings(
    corners: NDArray[np.float64], axis: int, lines: list[NDArray[np.float64]]
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]:
    """Return the crossings of a grid of lines along an axis with triangles.

    Returns
    -------
    line : (M,) int
        Number of the line, in row-major order of the grid.
    heights : (M,) float
        Coordinate of the crossing along the axis.
    turns : (M,) int
        1 where a line in the direction of the axis enters the inside, −1 where it
        leaves it.
    """
    sides = [(axis + 1) % 3, (axis + 2) % 3]
    flat = corners[:, :, sides]
    spans = [
        (
            np.searchsorted(steps, flat[:, :, side].min(axis=1)),
            np.searchsorted(steps, flat[:, :, side].max(axis=1)),
        )
        for side, steps in enumerate(lines)
    ]
    (left, right), (bottom, top) = spans
    counts = (right - left) * (top - bottom)
    triangle = np.repeat(np.arange(len(corners)), counts)
    rank = np.arange(len(triangle)) - np.repeat(np.cumsum(counts) - counts, counts)
    column, row = np.divmod(rank, (top - bottom)[triangle])
    column, row = column + left[triangle], row + bottom[triangle]
    spots = np.stack([lines[0][column], lines[1][row]], axis=1)
    hit, heights, turns = _crossings_of(corners[triangle], axis, spots)
    line = column * len(lines[1]) + row
    return line[hit], heights, turns


def _crossings_of(
    corners: NDArray[np.float64], axis: int, spots: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]:
    """Return where lines along an axis cross a triangle each.

    Parameters
    ----------
    corners : (M, 3, 3) float
        Corners of the triangles, counter-clockwise seen from outside.
    axis : int
        0, 1 or 2: the lines are parallel to X, Y or Z.
    spots : (M, 2) float
        The other two coordinates of each line, in cyclic order.

    Returns
    -------
    hit : (H,) int
        Rows of the lines that meet their triangle.
    heights : (H,) float
        Coordinate of the crossing along the axis.
    turns : (H,) int
        1 where a line in the direction of the axis enters the inside, −1 where it
        leaves it.
    """
    a, b, c = np.moveaxis(corners[:, :, [(axis + 1) % 3, (axis + 2) % 3]], 1, 0)
    double_area = cross_2d(b - a, c - a)
    facing = double_area != 0  # the others are parallel to the lines
    shares = np.zeros((len(corners), 3))
    np.divide(cross_2d(spots - a, c - a), double_area, out=shares[:, 1], where=facing)
    np.divide(cross_2d(b - a, spots - a), double_area, out=shares[:, 2], where=facing)
    shares[:, 0] = 1 - shares[:, 1] - shares[:, 2]
    hit = np.flatnonzero(facing & (shares >= 0).all(axis=1))
    heights = (corners[hit, :, axis] * shares[hit]).sum(axis=1)
    return hit, heights, -np.sign(double_area[hit]).astype(np.int64)
