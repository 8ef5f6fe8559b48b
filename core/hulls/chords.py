"""Chords: segments of axis-parallel lines that run through the inside of a shape.

Each chord stands for the volume of the prism around it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.frames import cross_2d
from ..steps.rows import ranges

# Distance between two lines, and longest chord, as a share of the longest side of the
# bounding box.
_STEP = 1 / 40
# Lines and places on chords are spread by multiples of these, modulo 1. Unlike those of
# a grid, no rows of them run along the sides of a box.
_GOLDEN, _SILVER = (5**0.5 - 1) / 2, 2**0.5 - 1
# Pairs of triangles and lines in a band, if all triangles were in it.
_PAIRS_IN_BAND = 200_000


def chords_along(
    corners: NDArray[np.float64], axis: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the chords along an axis, split into short ones.

    Lines form a Fibonacci lattice. A line is inside where it has entered more triangles
    than it has left.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of the triangles, counter-clockwise seen from outside.
    axis : int
        0, 1 or 2: the lines are parallel to X, Y or Z.

    Returns
    -------
    places : (C, 3) float
        A point of each chord.
    volumes : (C,) float
        Volume of the prism around each chord. Their sum estimates the volume inside.
    """
    sides = [(axis + 1) % 3, (axis + 2) % 3]
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    step = float((high - low).max()) * _STEP
    spots, area = _lattice(low[sides], high[sides], step)
    crossings = _crossings(corners, axis, spots)
    line, heights, _, first, depths = in_order(*crossings)
    inside = np.flatnonzero((depths[:-1] > 0) & ~first[1:])
    lengths = heights[inside + 1] - heights[inside]
    n_pieces = np.ceil(lengths / step).astype(np.int64)
    chord, rank = ranges(n_pieces)
    line = line[inside][chord]
    shares = (rank + line * _SILVER % 1) / n_pieces[chord]
    places = np.empty((len(chord), 3))
    places[:, axis] = heights[inside][chord] + shares * lengths[chord]
    places[:, sides] = spots[line]
    return places, (lengths / np.maximum(n_pieces, 1))[chord] * area


def in_order(
    line: NDArray[np.int64], heights: NDArray[np.float64], turns: NDArray[np.int64]
) -> tuple[
    NDArray[np.int64],
    NDArray[np.float64],
    NDArray[np.int64],
    NDArray[np.bool_],
    NDArray[np.int64],
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


def _lattice(
    low: NDArray[np.float64], high: NDArray[np.float64], step: float
) -> tuple[NDArray[np.float64], float]:
    """Return points of a rectangle, (L, 2) by their first coordinate, and their area.

    About as many as in a square grid with a distance of `step`.
    """
    widths = np.maximum(high - low, step)
    number = np.arange(max(int(np.prod(widths) / step**2), 1))
    shares = np.stack([(number + 0.5) / len(number), (number * _GOLDEN) % 1], axis=1)
    return low + shares * widths, float(np.prod(widths)) / len(number)


def _crossings(
    corners: NDArray[np.float64], axis: int, spots: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]:
    """Return the crossings of lines along an axis with triangles.

    Returns
    -------
    line : (M,) int
        Row of the line.
    heights : (M,) float
        Coordinate of the crossing along the axis.
    turns : (M,) int
        1 where a line in the direction of the axis enters the inside, −1 where it
        leaves it.
    """
    flat = corners[:, :, [(axis + 1) % 3, (axis + 2) % 3]]
    low, high = flat.min(axis=1), flat.max(axis=1)
    found = []
    for lines in _bands(spots, low, high):
        x, y = spots[lines].T
        rows = np.flatnonzero((low[:, 1] <= y.max()) & (high[:, 1] >= y.min()))
        left, right = (np.searchsorted(x, ends[rows, 0]) for ends in (low, high))
        owner, rank = ranges(right - left)
        triangle, place = rows[owner], left[owner] + rank
        near = (low[triangle, 1] <= y[place]) & (y[place] <= high[triangle, 1])
        triangle, line = triangle[near], lines[place[near]]
        hit, heights, turns = _crossings_of(corners[triangle], axis, spots[line])
        found.append((line[hit], heights, turns))
    line, heights, turns = (np.concatenate(each) for each in zip(*found, strict=True))
    return line, heights, turns


def _bands(
    spots: NDArray[np.float64], low: NDArray[np.float64], high: NDArray[np.float64]
) -> list[NDArray[np.int64]]:
    """Divide lines into bands by their second coordinate; return the rows of each.

    `low` and `high` (T, 2) are the ends of triangles. The more pairs of a triangle and
    a line there are that meet by the first coordinate, the narrower are the bands: most
    of the pairs are far from each other by the second one.
    """
    left, right = (np.searchsorted(spots[:, 0], ends[:, 0]) for ends in (low, high))
    n_bands = min(1 + int((right - left).sum()) // _PAIRS_IN_BAND, len(spots))
    order = np.argsort(spots[:, 1], kind="stable")
    return [np.sort(rows) for rows in np.array_split(order, n_bands)]


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
