"""Smooths the seams of given parts without moving them far."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.sparse.csgraph import dijkstra

from ...geometry.graphs.components import nodes_at_seams
from ...geometry.graphs.face_graph import FaceGraph
from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.progress import Progress, Steps, within
from ..details.surface import roads
from ..part_psi import count_parts
from .graph_cut import SWEEPS, cut_seams

# Distance from a part at which a polygon's cost for that part is 1, as a share of the
# square root of the total area.
_UNIT = 0.05
# Cost that excludes a part. Capacities of the graph cut are scaled to integers: a much
# larger cost would round the others to 0.
_NEVER = 1e3
# A polygon at this share of its part's greatest depth, or deeper, stays in the part.
_CORE = 0.5


def smooth_seams(
    graph: FaceGraph,
    labels: IntArray,
    chosen: Sequence[int],
    smoothness: float,
    sweeps: int = SWEEPS,
) -> Steps[IntArray]:
    """Move the seams of some parts into short lines and creases near the given seams.

    This is the graph cut of eq. 4. Its data term is the distance of a polygon from a
    part, not a distance in the embedding, so that edits by hand are kept.

    Parameters
    ----------
    graph : FaceGraph
    labels : (P,) int
        Part of each node, in 0…K − 1, each used.
    chosen : sequence of int
        Parts whose seams move. Seams between two other parts stay.
    smoothness : float
        Weight lambda of the seams' length (eq. 4).
    sweeps : int, optional
        Largest number of sweeps over all parts.

    Returns
    -------
    Steps of (P,) int
        The new labels. No part vanishes: nodes deep inside a part stay in it.
    """
    n_parts = count_parts(labels)
    free = np.isin(np.arange(n_parts), chosen)
    costs = yield from within(_costs(graph, labels, free), 0.0, 0.4)
    cut = cut_seams(graph, labels, costs, smoothness, sweeps)
    return (yield from within(cut, 0.4, 1.0))


def _costs(graph: FaceGraph, labels: IntArray, free: BoolArray) -> Steps[FloatArray]:
    """Return the data term (P, K): distances of nodes from parts along the surface.

    `free` (K,) says which parts' seams move.
    """
    yield Progress("Seams", 0.0)
    n_parts, may_leave = len(free), free[labels]
    unit = _UNIT * float(np.sqrt(graph.areas.sum()))
    ways = roads(graph, 1e-6 * unit)
    costs = np.full((graph.n_polygons, n_parts), _NEVER)
    rim = np.flatnonzero(nodes_at_seams(graph.neighbors, labels))
    depths = np.full(graph.n_polygons, 4 * unit)
    for part in range(n_parts):
        yield Progress("Seams", part / n_parts)
        own = labels == part
        starts = rim[own[rim]]
        if len(starts) == 0:
            continue
        away = dijkstra(
            ways, directed=False, indices=starts, min_only=True, limit=4 * unit
        )
        np.minimum(depths, away, out=depths, where=~own)
        # Seams between two parts that are not free stay.
        near = np.flatnonzero((away < np.inf) & (free[part] | may_leave))
        costs[near, part] = away[near] / unit
    yield Progress("Seams", 1.0)
    deepest = np.zeros(n_parts)
    np.maximum.at(deepest, labels, depths)
    costs[depths >= _CORE * deepest[labels]] = _NEVER
    costs[np.arange(len(labels)), labels] = 0.0
    return costs
