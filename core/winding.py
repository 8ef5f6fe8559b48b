"""Which way is out of a closed surface that only points of it are known of.

By the formula of Gauss the winding number around a place is a sum over the surface of
its outward normals, each weakened by its distance: 1 inside, 0 outside, one half on the
surface itself. Asked of all points at once, the latter gives the normals, as in
parametric Gauss reconstruction (Lin et al. 2022): one system of linear equations that
knows the whole shape, thin limbs and both sides of a wall.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from .progress import Progress, Steps

# Neighbors that spacing is measured by.
_NEIGHBORS = 7
# Weight of short normals against exact winding numbers: noise is not to be explained.
_REGULARITY = 4.0
# Points whose equations are made at a time.
_ROWS_PER_STEP = 64
# Steps to the solution, and squared errors of winding numbers that are close enough.
_MOST_STEPS = 60
_CLOSE = 1e-6
# Normals around a place that are averaged there.
_AVERAGED = 4


def outward_directions(
    points: NDArray[np.float64], n_drawn: int
) -> Steps[NDArray[np.float64]]:
    """Return unit vectors out of the shape at points spread over its surface, (N, 3).

    Parameters
    ----------
    points : (N, 3) float
    n_drawn : int
        Points that get an unknown normal each, the others the mean of the nearest.
        Memory grows with the square; of fewer, noise is averaged.
    """
    drawn = np.random.default_rng(0).permutation(len(points))[:n_drawn]
    few = points[drawn]
    tree = cKDTree(few)
    n_nearest = min(_NEIGHBORS, len(few) - 1) + 1
    width = float(np.median(tree.query(few, n_nearest)[0][:, 1:].mean(axis=1)))
    normals = yield from _normals(few, width)
    distances, nearest = tree.query(points, min(_AVERAGED, len(few)))
    says = 1.0 / (distances + width)
    return unit(np.einsum("qk,qkd->qd", says, normals[nearest]))


def unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return vectors (N, 3) with length 1, those without direction as they are."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, lengths, out=vectors.copy(), where=lengths > 0)


def _normals(points: NDArray[np.float64], width: float) -> Steps[NDArray[np.float64]]:
    """Return the shortest vectors (N, 3) that wind around every point by a half."""
    n_points = len(points)
    flows = np.empty((n_points, 3 * n_points), dtype=np.float32)
    places = points.astype(np.float32)
    for start in range(0, n_points, _ROWS_PER_STEP):
        yield Progress("Normals", 0.5 * start / n_points)
        rows = slice(start, start + _ROWS_PER_STEP)
        offsets = places - places[rows, None]
        distances = np.maximum(np.linalg.norm(offsets, axis=2), np.float32(width))
        flows[rows] = (offsets / distances[:, :, None] ** 3).reshape(-1, 3 * n_points)
    regular = (_REGULARITY - 1) * np.einsum("nm,nm->n", flows, flows)
    # Lengths, and so the half and the full angle of space, do not matter.
    weights = np.zeros(n_points, dtype=np.float32)
    missing = np.ones(n_points, dtype=np.float32)
    direction, error = missing, float(n_points)
    for step in range(_MOST_STEPS):  # of conjugate gradients
        yield Progress("Normals", 0.5 + 0.5 * step / _MOST_STEPS)
        change = flows @ (direction @ flows) + regular * direction
        length = error / float(direction @ change)
        weights = weights + length * direction
        missing = missing - length * change
        former, error = error, float(missing @ missing)
        if error < _CLOSE * n_points:
            break
        direction = missing + error / former * direction
    return unit((weights @ flows).reshape(-1, 3).astype(np.float64))
