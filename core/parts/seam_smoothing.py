"""Seams of given parts made smooth, near to where they are."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from ..geometry.face_graph import FaceGraph
from ..steps.progress import Steps
from .graph_cut import cut_seams

# A polygon dislikes a part by its distance from it: 1 at this one, in square roots of
# the area.
_UNIT = 0.05
# What no seam is worth. Capacities are whole numbers: far more would hide the rest.
_NEVER = 1e3
# What is so deep in a part stays there, in shares of the greatest depth.
_CORE = 0.5


def smooth_seams(
    graph: FaceGraph,
    labels: NDArray[np.int64],
    chosen: Sequence[int],
    smoothness: float,
) -> Steps[NDArray[np.int64]]:
    """Cut the seams of some parts anew: short, in creases, and near to the given ones.

    The graph cut of eq. 4, whose data term is here how far a polygon is from a part,
    so that what was edited by hand is kept.

    Parameters
    ----------
    graph : FaceGraph
    labels : (P,) int
        In 0…K − 1, each used.
    chosen : sequence of int
        Parts whose seams move; those between others stay.
    smoothness : float
        lambda.

    Returns
    -------
    labels : (P,) int
        All parts are still there: what is deep in one never leaves it.
    """
    n_parts = int(labels.max()) + 1
    costs = _costs(graph, labels, n_parts)
    own = labels[:, None] == np.arange(n_parts)
    free = np.isin(np.arange(n_parts), chosen)
    costs[~own & ~free[labels][:, None] & ~free] = _NEVER
    return (yield from cut_seams(graph, labels, costs, smoothness))


def _costs(
    graph: FaceGraph, labels: NDArray[np.int64], n_parts: int
) -> NDArray[np.float64]:
    """Return how far each polygon is from each part, along the surface, (P, K)."""
    one, other = graph.neighbors.T
    steps = np.linalg.norm(graph.centers[one] - graph.centers[other], axis=1)
    unit = _UNIT * float(np.sqrt(graph.areas.sum()))
    # Polygons at one place are neighbors, too.
    ways = sparse.coo_array(
        (np.maximum(steps, 1e-6 * unit), (one, other)),
        shape=(graph.n_polygons,) * 2,
    ).tocsr()
    costs = np.full((graph.n_polygons, n_parts), np.inf)
    ends = labels[graph.neighbors]
    rim = np.unique(graph.neighbors[ends[:, 0] != ends[:, 1]])
    for part in range(n_parts):
        starts = rim[labels[rim] == part]
        if len(starts):
            costs[:, part] = dijkstra(
                ways, directed=False, indices=starts, min_only=True, limit=4 * unit
            )
    costs[np.arange(len(labels)), labels] = np.inf
    depths = np.minimum(costs.min(axis=1), 4 * unit)
    deepest = np.zeros(n_parts)
    np.maximum.at(deepest, labels, depths)
    costs[depths >= _CORE * deepest[labels]] = np.inf
    costs[np.arange(len(labels)), labels] = 0.0
    return np.minimum(costs / unit, _NEVER)
