"""Lines through a shape, as far as they run through its inside."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

# Lines across the longest side.
_LINES = 40


def chords_along(
    corners: NDArray[np.float64], axis: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return pieces of lines along an axis through the inside of triangles.

    Parameters
    ----------
    corners : (T, 3, 3) float
    axis : int

    Returns
    -------
    centers : (C, 3) float
    volumes : (C,) float
        Of the prism around each piece; in all, the volume as these lines see it.
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
    """Return where lines along an axis cross triangles.

    Returns
    -------
    line : (M,) int
        Of the lines in row-major order.
    heights : (M,) float
        Coordinate along the axis.
    turns : (M,) int
        1 where a line going up comes in, −1 where it goes out.
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
    a, b, c = np.moveaxis(flat[triangle], 1, 0)
    double_area = _cross(b - a, c - a)
    facing = double_area != 0  # others are seen edge on
    shares = np.zeros((len(triangle), 3))
    np.divide(_cross(spots - a, c - a), double_area, out=shares[:, 1], where=facing)
    np.divide(_cross(b - a, spots - a), double_area, out=shares[:, 2], where=facing)
    shares[:, 0] = 1 - shares[:, 1] - shares[:, 2]
    hit = facing & (shares >= 0).all(axis=1)
    heights = (corners[triangle, :, axis] * shares).sum(axis=1)
    line = column * len(lines[1]) + row
    return line[hit], heights[hit], -np.sign(double_area[hit]).astype(np.int64)


def _cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the cross products of vectors in the plane, (M,)."""
    product: NDArray[np.float64] = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return product
