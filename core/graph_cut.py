"""Seams between parts: the graph cut of eq. 4, by alpha-expansion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import breadth_first_order, maximum_flow

from .progress import Progress, Steps
from .surface import Surface

# How fast a seam gets cheaper with a concave bend, per radian.
_CREASE = 4.0
# A polygon's dislike of a label saturates here.
_MOST_DISLIKE = 4.0
# Length that lambda = 1 stands for, as a share of the square root of the area.
_SEAM_UNIT = 0.02
# Sweeps over all labels at most; two or three settle.
_SWEEPS = 4
# maximum_flow takes whole numbers: the largest capacity becomes this.
_LARGEST_CAPACITY = 2**24
# Expansions reach this many polygons from the current seam.
_BAND = 6


def distances_to_parts(
    embedding: NDArray[np.float64],
    labels: NDArray[np.int64],
    n_labels: int,
) -> NDArray[np.float64]:
    """Return how far each sample is from each label: the paper's data term of eq. 4.

    The negative logarithm of a Gaussian kernel of the distance to the center of the
    label's samples in the embedding, with the variance within parts, saturated.

    Parameters
    ----------
    embedding : (N, n) float
    labels : (N,) int
        In 0…`n_labels` − 1, each used.
    n_labels : int

    Returns
    -------
    costs : (N, K) float
        In 0…4.
    """
    members = np.eye(n_labels)[labels]
    sizes = np.maximum(members.sum(axis=0), 1.0)
    centers = (members.T @ embedding) / sizes[:, None]
    squared = ((embedding[:, None, :] - centers[None]) ** 2).sum(axis=2)
    # One variance for all parts: with its own, a wide part swallows narrow ones.
    variance = (members * squared).sum() / len(labels) + np.finfo(float).tiny
    costs: NDArray[np.float64] = np.minimum(squared / (2 * variance), _MOST_DISLIKE)
    return costs


def cut_seams(
    surface: Surface,
    labels: NDArray[np.int64],
    costs: NDArray[np.float64],
    smoothness: float,
) -> Steps[NDArray[np.int64]]:
    """Move the seams so that they are short, in creases, and true to the samples.

    Minimizes eq. 4, E(l) = sum of areas times `costs` + lambda times the length of the
    seams, where an edge in a concave crease counts less (the smoothness term). In a
    flat mesh, lengths of outline take the place of areas: seams cross it straight.

    Parameters
    ----------
    surface : Surface
    labels : (P,) int
        Where to start, in 0…K − 1.
    costs : (P, K) float
        Data term per unit of area, or of outline.
    smoothness : float
        lambda.

    Returns
    -------
    labels : (P,) int
    """
    data = costs * surface.weights[:, None]
    unit = _SEAM_UNIT / np.sqrt(surface.areas.sum())
    seams = smoothness * unit * surface.lengths
    seams = seams * np.exp(-_CREASE * np.maximum(surface.bends, 0.0))
    cutter = _Expansion(surface.neighbors, data, seams)
    labels = labels.copy()
    n_labels = costs.shape[1]
    settled = np.zeros(n_labels, dtype=bool)
    for sweep in range(_SWEEPS):
        for label in range(n_labels):
            yield Progress("Seams", (sweep + label / n_labels) / _SWEEPS)
            if settled[label]:
                continue
            moved = cutter.expand(labels, label)
            if moved.any():
                settled[:] = False
                labels[moved] = label
            settled[label] = True
        if settled.all():
            break
    return labels


class _Expansion:
    """One alpha-expansion after the other over the same graph."""

    def __init__(
        self,
        neighbors: NDArray[np.int64],
        data: NDArray[np.float64],
        seams: NDArray[np.float64],
    ) -> None:
        self.neighbors, self.data, self.seams = neighbors, data, seams
        self.n_nodes = len(data)

    def expand(self, labels: NDArray[np.int64], label: int) -> NDArray[np.bool_]:
        """Return the nodes that better had `label`: one minimum cut."""
        band = self._band(labels == label)
        moved = np.zeros(self.n_nodes, dtype=bool)
        nodes = np.flatnonzero(band)
        if len(nodes) == 0:
            return moved
        place = np.full(self.n_nodes, -1)
        place[nodes] = np.arange(len(nodes))
        gain = self.data[nodes, label] - self.data[nodes, labels[nodes]]
        edges = band[self.neighbors].any(axis=1)
        one, other = self.neighbors[edges].T
        weights = self.seams[edges]
        arcs = []
        for here, there in ((one, other), (other, one)):
            # The far end keeps its label: moving costs or saves a seam.
            fixed = band[here] & ~band[there]
            before = labels[here[fixed]] != labels[there[fixed]]
            after = labels[there[fixed]] != label
            change = weights[fixed] * (after.astype(float) - before.astype(float))
            np.add.at(gain, place[here[fixed]], change)
        free = band[one] & band[other]
        one, other, weights = one[free], other[free], weights[free]
        alike = labels[one] == labels[other]
        arcs = [
            (place[one[alike]], place[other[alike]], weights[alike]),
            (place[other], place[one], weights),
        ]
        # Different labels: the seam is there anyway unless both move.
        np.add.at(gain, place[one[~alike]], -weights[~alike])
        tails, heads, capacities = (
            np.concatenate(part) for part in zip(*arcs, strict=True)
        )
        moved[nodes[_minimum_cut(gain, tails, heads, capacities)]] = True
        return moved

    def _band(self, region: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Return the nodes within `_BAND` steps outside `region`."""
        reached = region.copy()
        one, other = self.neighbors.T
        for _ in range(_BAND):
            front = reached.copy()
            front[one[reached[other]]] = True
            front[other[reached[one]]] = True
            reached = front
        return reached & ~region


def _minimum_cut(
    gain: NDArray[np.float64],
    tails: NDArray[np.int64],
    heads: NDArray[np.int64],
    capacities: NDArray[np.float64],
) -> NDArray[np.bool_]:
    """Return which nodes move, minimizing sum of gains + cut arcs.

    `gain` is what moving a node costs; an arc is paid for when its tail stays and its
    head moves. Staying is the source's side.
    """
    n_nodes = len(gain)
    source, sink = n_nodes, n_nodes + 1
    nodes = np.arange(n_nodes)
    costly = gain > 0
    # A node that costs to move is held by the source, one that saves by the sink.
    tails = np.concatenate([tails, np.full(costly.sum(), source), nodes[~costly]])
    heads = np.concatenate([heads, nodes[costly], np.full((~costly).sum(), sink)])
    capacities = np.concatenate([capacities, gain[costly], -gain[~costly]])
    graph = sparse.csr_array(
        (capacities, (tails.astype(np.int32), heads.astype(np.int32))),
        shape=(n_nodes + 2, n_nodes + 2),
    )
    graph.sum_duplicates()
    largest = graph.data.max(initial=0.0)
    if largest <= 0:
        return np.zeros(n_nodes, dtype=bool)
    graph.data = np.round(graph.data / largest * _LARGEST_CAPACITY).astype(np.int32)
    flow = maximum_flow(graph, source, sink, method="dinic").flow
    residual = sparse.csr_array(graph - flow)
    residual.data = np.maximum(residual.data, 0)
    residual.eliminate_zeros()
    staying = breadth_first_order(residual, source, return_predecessors=False)
    moves = np.ones(n_nodes + 2, dtype=bool)
    moves[staying] = False
    return moves[:n_nodes]
