"""Estimate hull volumes from the points that are farthest along fixed directions.

The extreme points are joined by the triangles that join their directions. The convex
hull of these points is no better an estimate and takes a hundred times as long.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ...geometry.directions import sphere_directions
from ...steps.arrays import FloatArray, IntArray
from ..convex_hull import convex_hull

# E unit vectors; extreme points are found along these and their opposites.
_DIRECTIONS = sphere_directions(96)[:48]
# Triangles of neighboring directions, (F, 3), counter-clockwise seen from outside.
_TRIANGLES = convex_hull(np.concatenate([_DIRECTIONS, -_DIRECTIONS]), 1.0).triangles


def reaches_of(points: FloatArray) -> FloatArray:
    """Return the coordinates of points along all E directions.

    Parameters
    ----------
    points : (N, 3) float

    Returns
    -------
    (E, N) float
    """
    return _DIRECTIONS @ points.T


def volumes_beside(
    points: FloatArray, reaches: FloatArray, ends: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Estimate the hull volumes of the first points and of the rest, for K splits.

    Parameters
    ----------
    points : (N, 3) float
        Sorted along the normal of the planes that split them.
    reaches : (E, N) float
        Their coordinates along the directions, as `reaches_of` returns them.
    ends : (K,) int
        Number of points before each split, ascending.

    Returns
    -------
    first, others : (K,) float
        Volumes of the points before and after each split.
    """
    edges = np.concatenate([[0], ends, [len(points)]])
    rows = np.zeros((len(ends) + 1, 2, len(reaches)), dtype=np.int64)
    for layer, (start, end) in enumerate(pairwise(edges.tolist())):
        if start < end:
            some = reaches[:, start:end]
            some.argmax(axis=1, out=rows[layer, 0])
            some.argmin(axis=1, out=rows[layer, 1])
    filled = (edges[:-1] < edges[1:])[:, None, None]
    rows = np.where(filled, rows + edges[:-1, None, None], 0)
    farthest = reaches[np.arange(len(reaches)), rows] * [[1], [-1]]
    farthest = np.where(filled, farthest, -np.inf)
    before = _running(rows[:-1], farthest[:-1])
    after = _running(rows[:0:-1], farthest[:0:-1])[::-1]
    volumes = _volumes_about(points, np.concatenate([before, after]))
    return volumes[: len(ends)], volumes[len(ends) :]


def _running(rows: IntArray, farthest: FloatArray) -> IntArray:
    """Return the rows of the extreme points of the first 1 to K layers, (K, 2 E)."""
    leads = farthest == np.maximum.accumulate(farthest, axis=0)
    layers = np.where(leads, np.arange(len(rows))[:, None, None], 0)
    layers = np.maximum.accumulate(layers, axis=0)
    running: IntArray = np.take_along_axis(rows, layers, axis=0)
    return running.reshape(len(rows), -1)


def _volumes_about(points: FloatArray, rows: IntArray) -> FloatArray:
    """Return the volumes enclosed by extreme points, whose rows are (K, 2 E), (K,)."""
    # Coordinate by coordinate, one row a direction: so NumPy takes a third of the time.
    chosen = np.ascontiguousarray(points[rows.T].transpose(2, 0, 1))
    a, b, c = (np.take(chosen, corner, axis=1) for corner in _TRIANGLES.T)
    sixfold = a[0] * (b[1] * c[2] - b[2] * c[1])
    sixfold += a[1] * (b[2] * c[0] - b[0] * c[2])
    sixfold += a[2] * (b[0] * c[1] - b[1] * c[0])
    return sixfold.sum(axis=0) / 6
