"""The points of a cloud as a graph: what labels move along where there are no faces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.face_graph import FaceGraph
from .splats import nearest_points

# Neighbors of a point, and how far off they may be, in the sides of the squares that
# the two points stand for.
_NEIGHBORS = 8
_REACH = 3.0


def neighbor_graph(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    areas: NDArray[np.float64],
) -> FaceGraph:
    """Return the graph of nearest neighbors on an oriented point cloud.

    Parameters
    ----------
    points, normals : (N, 3) float
    areas : (N,) float
        What each point stands for.
    """
    n_neighbors = min(_NEIGHBORS, len(points) - 1)
    nearest = nearest_points(points, normals, (points, normals), n_neighbors + 1)
    one = np.repeat(np.arange(len(points)), n_neighbors)
    pairs = np.sort(np.stack([one, nearest[:, 1:].ravel()], axis=1), axis=1)
    pairs = np.unique(pairs[pairs[:, 0] < pairs[:, 1]], axis=0)
    offsets = points[pairs[:, 1]] - points[pairs[:, 0]]
    sides = np.sqrt(areas[pairs].mean(axis=1))
    distances = np.linalg.norm(offsets, axis=1)
    near = distances <= _REACH * sides
    pairs, offsets, sides = pairs[near], offsets[near], sides[near]
    # By Crofton's formula a line crosses 2 / pi edges for each unit of its length and
    # unit of all edges' length on a unit of area: a seam gets the length of its line.
    density = (distances[near] / sides).sum() / len(points)
    lengths = np.pi * sides / (2 * max(density, np.finfo(float).tiny))
    one, other = normals[pairs[:, 0]], normals[pairs[:, 1]]
    angles = np.arccos(np.clip((one * other).sum(axis=1), -1.0, 1.0))
    # Normals that lean towards each other stand in a crease.
    creased = ((other - one) * offsets).sum(axis=1) < 0
    return FaceGraph(
        areas,
        points,
        normals,
        pairs,
        lengths=lengths,
        bends=np.where(creased, angles, -angles),
    )
