"""The graph of a cloud's points, used where there are no faces."""

from __future__ import annotations

import numpy as np

from ..geometry.graphs.face_graph import FaceGraph
from ..steps.arrays import FloatArray
from ..steps.progress import Progress, Steps
from .splats import nearest_points

# Nearest neighbors of each point.
_NEIGHBORS = 8
# Greatest length of an edge, in sides of the square that its two points stand for on
# average.
_REACH = 3.0


def neighbor_graph(
    points: FloatArray, normals: FloatArray, areas: FloatArray
) -> Steps[FaceGraph]:
    """Return the graph of nearest neighbors on an oriented point cloud.

    Parameters
    ----------
    points, normals : (N, 3) float
        Normals are outward unit vectors.
    areas : (N,) float
        Surface area that each point stands for.

    Returns
    -------
    Steps of FaceGraph
        Its nodes are the points.
    """
    yield Progress("Surface", 0.0)
    n_neighbors = min(_NEIGHBORS, len(points) - 1)
    nearest = nearest_points(points, normals, n_neighbors + 1)
    one = np.repeat(np.arange(len(points)), n_neighbors)
    pairs = np.sort(np.stack([one, nearest[:, 1:].ravel()], axis=1), axis=1)
    pairs = np.unique(pairs[pairs[:, 0] < pairs[:, 1]], axis=0)
    offsets = points[pairs[:, 1]] - points[pairs[:, 0]]
    sides = np.sqrt(areas[pairs].mean(axis=1))
    distances = np.linalg.norm(offsets, axis=1)
    near = distances <= _REACH * sides
    pairs, offsets, sides = pairs[near], offsets[near], sides[near]
    # By Crofton's formula, a line crosses 2 / pi edges per unit of its length, where
    # edges of total length 1 lie on each unit of area. With the lengths below, the
    # edges across a seam add up to the length of the seam.
    density = (distances[near] / sides).sum() / len(points)
    lengths = np.pi * sides / (2 * max(density, np.finfo(float).tiny))
    one, other = normals[pairs[:, 0]], normals[pairs[:, 1]]
    angles = np.arccos(np.clip((one * other).sum(axis=1), -1.0, 1.0))
    # In a crease, normals lean towards each other.
    creased = ((other - one) * offsets).sum(axis=1) < 0
    return FaceGraph(
        areas,
        points,
        normals,
        pairs,
        lengths=lengths,
        bends=np.where(creased, angles, -angles),
    )
