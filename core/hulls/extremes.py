"""Points of a shape that are farthest in fixed directions, and the volume about them.

The hull of these points would be as good, and takes a hundred times as long.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from .convex_hull import directions

# E directions; with their opposites they are those of extreme points.
_DIRECTIONS = directions(96)[:48]


def _triangles() -> NDArray[np.int64]:
    """Return triangles of neighboring directions, counter-clockwise from outside."""
    both = np.concatenate([_DIRECTIONS, -_DIRECTIONS])
    triangles = ConvexHull(both).simplices.astype(np.int64)
    inwards = np.linalg.det(both[triangles]) < 0
    triangles[inwards] = triangles[inwards, ::-1]
    return triangles


_TRIANGLES = _triangles()


def reaches_of(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far points (N, 3) are along the directions, (E, N)."""
    reaches: NDArray[np.float64] = _DIRECTIONS @ points.T
    return reaches


def volumes_beside(
    points: NDArray[np.float64],
    reaches: NDArray[np.float64],
    ends: NDArray[np.int64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the volumes about the first points and about the others.

    Parameters
    ----------
    points : (N, 3) float
    reaches : (E, N) float
        Of these points.
    ends : (K,) int
        How many points come first, rising.

    Returns
    -------
    first, others : (K,) float
    """
    rows = np.zeros((len(ends) + 1, 2, len(reaches)), dtype=np.int64)
    farthest = np.full(rows.shape, -np.inf)
    edges = [0, *ends.tolist(), len(points)]
    for k, (start, end) in enumerate(pairwise(edges)):
        if start < end:
            layer = reaches[:, start:end]
            rows[k] = layer.argmax(axis=1), layer.argmin(axis=1)
            farthest[k] = np.take_along_axis(layer, rows[k].T, axis=1).T
            farthest[k, 1] *= -1
            rows[k] += start
    return (
        _volumes_about(points[_running(rows[:-1], farthest[:-1])]),
        _volumes_about(points[_running(rows[:0:-1], farthest[:0:-1])])[::-1],
    )


def _running(
    rows: NDArray[np.int64], farthest: NDArray[np.float64]
) -> NDArray[np.int64]:
    """Return the row of what is farthest in one layer, in two and on, (K, 2 E)."""
    leads = farthest == np.maximum.accumulate(farthest, axis=0)
    layers = np.where(leads, np.arange(len(rows))[:, None, None], 0)
    layers = np.maximum.accumulate(layers, axis=0)
    running: NDArray[np.int64] = np.take_along_axis(rows, layers, axis=0)
    return running.reshape(len(rows), -1)


def _volumes_about(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the volume within extreme points (K, 2 E, 3), (K,)."""
    a, b, c = np.moveaxis(points[:, _TRIANGLES], 2, 0)
    volumes: NDArray[np.float64] = np.einsum("kfd,kfd->k", np.cross(b, c), a) / 6
    return volumes
