"""Chords: segments of axis-parallel lines that run through the inside of a shape.

Each chord stands for the volume of the prism around it.
"""

from __future__ import annotations

import numpy as np

from ..steps.arrays import FloatArray, IntArray
from ..steps.rows import ranges
from .measure.line_crossings import TURNS, LineCrossings, in_order

# Distance between two lines, and longest chord, as a share of the longest side of the
# bounding box.
_STEP = 1 / 40
# Lines and places on chords are spread by multiples of these, modulo 1. Unlike those of
# a grid, no rows of them run along the sides of a box.
_GOLDEN, _SILVER = (5**0.5 - 1) / 2, 2**0.5 - 1


def chords_along(
    crossings: LineCrossings, corners: FloatArray, axis: int
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Return the chords along an axis, split into short ones.

    Lines form a Fibonacci lattice. A line is inside where it has entered more triangles
    than it has left.

    Parameters
    ----------
    crossings : LineCrossings
        Of lines and the surface.
    corners : (N, 3) float
        Points with the same bounding box as the surface.
    axis : int
        0, 1 or 2: the lines are parallel to X, Y or Z.

    Returns
    -------
    places : (C, 3) float
        A point of each chord.
    volumes : (C,) float
        Volume of the prism around each chord. Their sum estimates the volume inside.
    depths : (C,) int
        Number of solids that each chord is inside.
    """
    sides = TURNS[axis, :2]
    low, high = corners.min(axis=0), corners.max(axis=0)
    step = float((high - low).max()) * _STEP
    spots, area = _lattice(low[sides], high[sides], step)
    met = crossings.of(np.full(len(spots), axis), spots)
    line, heights, _, first, depths = in_order(*met)
    inside = np.flatnonzero((depths[:-1] > 0) & ~first[1:])
    lengths = heights[inside + 1] - heights[inside]
    n_pieces = np.ceil(lengths / step).astype(np.int64)
    chord, rank = ranges(n_pieces)
    line = line[inside][chord]
    shares = (rank + line * _SILVER % 1) / n_pieces[chord]
    places = np.empty((len(chord), 3))
    places[:, axis] = heights[inside][chord] + shares * lengths[chord]
    places[:, sides] = spots[line]
    volumes = (lengths / np.maximum(n_pieces, 1))[chord] * area
    return places, volumes, depths[inside][chord]


def _lattice(
    low: FloatArray, high: FloatArray, step: float
) -> tuple[FloatArray, float]:
    """Return points of a rectangle, (L, 2) by their first coordinate, and their area.

    About as many as in a square grid with a distance of `step`.
    """
    widths = np.maximum(high - low, step)
    number = np.arange(max(int(np.prod(widths) / step**2), 1))
    shares = np.stack([(number + 0.5) / len(number), (number * _GOLDEN) % 1], axis=1)
    return low + shares * widths, float(np.prod(widths)) / len(number)
