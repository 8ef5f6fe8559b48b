"""Seams between parts: the graph cut of eq. 4, by alpha-expansion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import breadth_first_order, maximum_flow

from ..geometry.face_graph import FaceGraph
from ..steps.progress import Progress, Steps

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
    graph: FaceGraph,
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
    graph : FaceGraph
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
    data = costs * graph.weights[:, None]
    unit = _SEAM_UNIT / np.sqrt(graph.areas.sum())
    seams = smoothness * unit * graph.lengths
    seams = seams * np.exp(-_CREASE * np.maximum(graph.bends, 0.0))
    cutter = _Expansion(graph.neighbors, data, seams)
    labels = labels.copy()
    n_labels = costs.shape[1]
    settled, restless = np.zeros((2, n_labels), dtype=bool)
    seen = np.zeros((n_labels, len(labels)), dtype=bool)
    for sweep in range(_SWEEPS):
        for label in range(n_labels):
            yield Progress("Seams", (sweep + label / n_labels) / _SWEEPS)
            if settled[label]:
                continue
            moved, seen[label] = cutter.expand(labels, label)
            if len(moved):
                # Others stay as they are where they have seen nothing that moved.
                settled &= ~(restless | seen[:, moved].any(axis=1))
                labels[moved] = label
            settled[label], restless[label] = True, len(moved) > 0
        if settled.all():
            break
    return labels


class _Expansion:
    """One alpha-expansion after the other over the same graph.

    What an expansion takes goes with the size of its band, not with that of the graph.
    """

    def __init__(
        self,
        neighbors: NDArray[np.int64],
        data: NDArray[np.float64],
        seams: NDArray[np.float64],
    ) -> None:
        self.data = data
        n_nodes = len(data)
        ends = np.concatenate([neighbors, neighbors[:, ::-1]])
        # Arcs in both directions, by their tails; two nodes may have several edges.
        graph = sparse.csr_array(
            (np.tile(seams, 2), tuple(ends.T)), shape=(n_nodes, n_nodes)
        )
        graph.sum_duplicates()
        self.heads, self.seams = graph.indices, graph.data
        self.starts = graph.indptr[:-1]
        self.n_arcs = np.diff(graph.indptr)

    def expand(
        self, labels: NDArray[np.int64], label: int
    ) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        """Return the nodes that better had `label`: one minimum cut.

        And which nodes it has seen, (P,): as long as these keep their labels, it would
        come out the same.
        """
        seen = labels == label
        nodes = self._band(seen)
        if len(nodes) == 0:
            return nodes, seen
        own = labels[nodes]
        gain = self.data[nodes, label] - self.data[nodes, own]
        arcs = self._arcs(nodes)
        tails = np.repeat(np.arange(len(nodes)), self.n_arcs[nodes])
        ends, weights = self.heads[arcs], self.seams[arcs]
        seen[ends] = True
        heads = np.searchsorted(nodes, ends)
        heads[heads == len(nodes)] = 0
        free = nodes[heads] == ends
        alike = own[tails] == labels[ends]
        # The far end keeps its label: moving costs or saves a seam. Where both may move
        # and have different labels, the seam is there anyway unless both do; one of the
        # two arcs stands for that.
        first = free & ~alike & (tails < heads)
        gained = np.where(free, first, labels[ends] == label)
        lost = alike & ~free
        gain += np.bincount(tails, weights * (lost.astype(int) - gained), len(nodes))
        capacities = np.where(first, 0.0, weights)[free]
        moves = _minimum_cut(gain, tails[free], heads[free], capacities)
        return nodes[moves], seen

    def _band(self, reached: NDArray[np.bool_]) -> NDArray[np.int64]:
        """Return the nodes within `_BAND` steps outside a region, ascending."""
        front = np.flatnonzero(reached)
        band: list[NDArray[np.int64]] = []
        for _ in range(_BAND):
            ends = self.heads[self._arcs(front)]
            front = np.unique(ends[~reached[ends]])
            reached[front] = True
            band.append(front)
        return np.sort(np.concatenate(band))

    def _arcs(self, nodes: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the arcs that leave nodes, those of one after those of the other."""
        sizes = self.n_arcs[nodes]
        firsts = self.starts[nodes] - np.cumsum(sizes) + sizes
        arcs: NDArray[np.int64] = np.repeat(firsts, sizes)
        return arcs + np.arange(len(arcs))


def _minimum_cut(
    gain: NDArray[np.float64],
    tails: NDArray[np.int64],
    heads: NDArray[np.int64],
    capacities: NDArray[np.float64],
) -> NDArray[np.bool_]:
    """Return which nodes move, minimizing sum of gains + cut arcs.

    `gain` is what moving a node costs; an arc is paid for when its tail stays and its
    head moves. Arcs are sorted and there are both of every two nodes, if need be one
    without capacity: all that SciPy's flow asks for. Staying is the source's side.
    """
    n_nodes = len(gain)
    source, sink = n_nodes, n_nodes + 1
    nodes = np.arange(n_nodes)
    # A node that costs to move is held by the source, one that saves by the sink.
    holders = np.where(gain > 0, source, sink)
    tails = np.concatenate([tails, nodes, holders])
    heads = np.concatenate([heads, holders, nodes])
    capacities = np.concatenate(
        [capacities, np.maximum(-gain, 0.0), np.maximum(gain, 0.0)]
    )
    largest = capacities.max(initial=0.0)
    if largest <= 0:
        return np.zeros(n_nodes, dtype=bool)
    order = np.argsort(tails * (n_nodes + 2) + heads, kind="stable")
    capacities = np.round(capacities[order] / largest * _LARGEST_CAPACITY)
    heads = heads[order].astype(np.int32)
    starts = np.searchsorted(tails[order], np.arange(n_nodes + 3)).astype(np.int32)
    shape = n_nodes + 2, n_nodes + 2
    graph = sparse.csr_array((capacities.astype(np.int32), heads, starts), shape)
    flow = maximum_flow(graph, source, sink, method="dinic").flow
    left = graph.data > flow.data
    starts = np.concatenate([[0], np.cumsum(left)])[starts]
    residual = sparse.csr_array((left[left], heads[left], starts), shape)
    staying = breadth_first_order(residual, source, return_predecessors=False)
    moves = np.ones(n_nodes + 2, dtype=bool)
    moves[staying] = False
    return moves[:n_nodes]
