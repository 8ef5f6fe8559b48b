"""Estimate hull volumes from the points that are farthest along fixed directions.

The extreme points are joined by the triangles that join their directions. The convex
hull of these points is no better an estimate and takes a hundred times as long.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from ...geometry.frames import cross
from ..convex_hull import directions

# E unit vectors; extreme points are found along these and their opposites.
_DIRECTIONS = directions(96)[:48]


def _triangles() -> NDArray[np.int64]:
    """Return triangles of neighboring directions, (F, 3), counter-clockwise outside."""
    both = np.concatenate([_DIRECTIONS, -_DIRECTIONS])
    triangles = ConvexHull(both).simplices.astype(np.int64)
    inwards = np.linalg.det(both[triangles]) < 0
    triangles[inwards] = triangles[inwards, ::-1]
    return triangles


_TRIANGLES = _triangles()


def reaches_of(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the coordinates of points along all E directions.

    Parameters
    ----------
    points : (N, 3) float

    Returns
    -------
    (E, N) float
    """
    reaches: NDArray[np.float64] = _DIRECTIONS @ points.T
    return reaches


def volumes_beside(
    points: NDArray[np.float64],
    reaches: NDArray[np.float64],
    ends: NDArray[np.int64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
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
    rows = np.zeros((len(ends) + 1, 2, len(reaches)), dtype=np.int64)
    farthest = np.full(rows.shape, -np.inf)
    edges = [0, *ends.tolist(), len(points)]
    for k, (start, end) in enumerate(pairwise(edges)):
        if start < end:
            layer = reaches[:, start:end]
            rows[k] = layer.argmax(axis=1), layer.argmin(axis=1)
            farthest[k] = layer[np.arange(len(layer)), rows[k]]
            farthest[k, 1] *= -1
            rows[k] += start
    before = _running(rows[:-1], farthest[:-1])
    after = _running(rows[:0:-1], farthest[:0:-1])[::-1]
    volumes = _volumes_about(points[np.concatenate([before, after])])
    return volumes[: len(ends)], volumes[len(ends) :]


def _running(
    rows: NDArray[np.int64], farthest: NDArray[np.float64]
) -> NDArray[np.int64]:
    """Return the rows of the extreme points of the first 1 to K layers, (K, 2 E)."""
    leads = farthest == np.maximum.accumulate(farthest, axis=0)
    layers = np.where(leads, np.arange(len(rows))[:, None, None], 0)
    layers = np.maximum.accumulate(layers, axis=0)
    running: NDArray[np.int64] = np.take_along_axis(rows, layers, axis=0)
    return running.reshape(len(rows), -1)


def _volumes_about(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the volumes enclosed by extreme points (K, 2 E, 3), (K,)."""
    a, b, c = (points[:, corner] for corner in _TRIANGLES.T)
    volumes: NDArray[np.float64] = np.einsum("kfd,kfd->k", cross(b, c), a) / 6
    return volumes
