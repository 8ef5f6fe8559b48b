"""Cuts the seams between parts: minimizes eq. 4 by alpha-expansion."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import breadth_first_order, maximum_flow

from ...geometry.graphs.face_graph import FaceGraph
from ...steps.arrays import BoolArray, FloatArray, Int32Array, IntArray
from ...steps.progress import Progress, Steps

# Cost of a seam as long as the square root of the area, at lambda = 1.
_SEAM_UNIT = 0.02
# Largest number of sweeps over all labels. Most shapes need two or three.
SWEEPS = 4
# `maximum_flow` needs integers: the largest capacity is scaled to this.
_LARGEST_CAPACITY = 2**24
# An expansion may relabel nodes up to this many steps away from the label's region.
_BAND = 6


def cut_seams(
    graph: FaceGraph,
    labels: IntArray,
    costs: FloatArray,
    smoothness: float,
    sweeps: int = SWEEPS,
) -> Steps[IntArray]:
    """Move the seams to a minimum of eq. 4, starting from given labels.

    The energy E(l) is the sum of areas times `costs`, plus lambda times the length of
    the seams, in which an edge in a concave crease counts less. For a flat mesh, the
    length of the outline replaces the area, so that seams run straight across.

    Parameters
    ----------
    graph : FaceGraph
    labels : (P,) int
        Label of each node at the start, in 0…K − 1.
    costs : (P, K) float
        Data term: cost of each label for each node, per share of the area or outline.
    smoothness : float
        Weight lambda of the seams' length.
    sweeps : int, optional
        Largest number of sweeps over all labels. Each moves seams a few nodes further.

    Returns
    -------
    Steps of (P,) int
        The new labels.
    """
    unit = _SEAM_UNIT / np.sqrt(graph.areas.sum())
    cutter = _Expansion(graph, costs, smoothness * unit)
    labels, n_labels = labels.copy(), costs.shape[1]
    settled, restless = np.zeros((2, n_labels), dtype=bool)
    seen = np.zeros((n_labels, len(labels)), dtype=bool)
    for sweep in range(sweeps):
        for label in range(n_labels):
            if settled[label]:
                continue
            yield Progress("Seams", (sweep + label / n_labels) / sweeps)
            moved, seen[label] = cutter.expand(labels, label)
            if len(moved):
                # Expand labels again that moved nodes last, or depend on moved ones.
                settled &= ~(restless | seen[:, moved].any(axis=1))
                labels[moved] = label
            settled[label], restless[label] = True, len(moved) > 0
        if settled.all():
            break
    return labels


class _Expansion:
    """Alpha-expansions of labels on one graph.

    The time of an expansion depends on the size of its band, not of the whole graph.
    """

    def __init__(self, graph: FaceGraph, costs: FloatArray, price: float) -> None:
        # The cost of each label for each node of its size, (P, K).
        self.costs = costs * graph.weights[:, None]
        # Arcs in both directions, sorted by tail. NumPy takes rows by numbers of 64
        # bits quicker.
        arcs = graph.seams_between
        self.heads, self.seams = arcs.indices.astype(np.int64), price * arcs.data
        self.ends = arcs.indptr[1:].astype(np.int64)
        self.n_arcs = np.diff(arcs.indptr).astype(np.int64)
        # The most that a node can save by a move: the cost of all seams around it.
        self._saved = price * arcs.sum(axis=1)
        self._places = np.zeros(len(costs), dtype=np.int64)

    def expand(self, labels: IntArray, label: int) -> tuple[IntArray, BoolArray]:
        """Return the nodes that should change to `label`, by one minimum cut.

        Return also which nodes this depends on, (P,) bool: while their labels stay, the
        result stays.
        """
        seen = labels == label
        nodes = self._band(seen)
        gain = self.costs[nodes, label] - self.costs[nodes, labels[nodes]]
        # No seam around the others saves as much as their move costs.
        may = np.flatnonzero(gain <= self._saved.take(nodes))
        nodes, gain = nodes.take(may), gain.take(may)
        if len(nodes) == 0:
            return nodes, seen
        numbers = np.arange(len(nodes))
        arcs, tails = self._arcs(nodes), np.repeat(numbers, self.n_arcs.take(nodes))
        ends, weights = self.heads.take(arcs), self.seams.take(arcs)
        seen[ends] = True
        self._places[nodes] = numbers
        heads = self._places.take(ends)
        heads[heads >= len(nodes)] = 0  # places of former bands
        free, beside = nodes.take(heads) == ends, labels.take(ends)
        alike = labels.take(nodes).take(tails) == beside
        # If the head of an arc cannot move, moving the tail adds or removes their seam.
        # If both can and their labels differ, the seam goes only if both move: its cost
        # is subtracted where the first arc starts, and the arc back adds it again if
        # that node moves alone.
        apart = free & ~alike
        first = apart & (tails < heads)
        gained = np.where(free, first, beside == label)
        lost = alike & ~free
        gain += np.bincount(tails, weights * (lost.astype(int) - gained), len(nodes))
        inner = np.flatnonzero(free)
        there, back = (
            (weights * ~none).take(inner) for none in (first, apart & ~first)
        )
        moves = _minimum_cut(gain, tails.take(inner), heads.take(inner), there, back)
        return nodes[moves], seen

    def _band(self, reached: BoolArray) -> IntArray:
        """Return nodes up to `_BAND` steps outside a region, sorted, and mark them."""
        front = np.flatnonzero(reached)
        band: list[IntArray] = []
        for _ in range(_BAND):
            ends = self.heads.take(self._arcs(front))
            ends = ends[~reached.take(ends)]
            # Each node once: `np.unique` would sort.
            turns = np.arange(len(ends))
            self._places[ends] = turns
            front = ends[self._places.take(ends) == turns]
            reached[front] = True
            band.append(front)
        return np.sort(np.concatenate(band))

    def _arcs(self, nodes: IntArray) -> IntArray:
        """Return the arcs that leave the nodes, by node."""
        counts = self.n_arcs.take(nodes)
        sums = np.cumsum(counts)
        arcs = np.repeat(self.ends.take(nodes) - sums, counts)
        return arcs + np.arange(len(arcs))


def _minimum_cut(
    gain: FloatArray,
    tails: IntArray,
    heads: IntArray,
    there: FloatArray,
    back: FloatArray,
) -> BoolArray:
    """Return which nodes move so that the total cost is least, (N,) bool.

    A node that moves costs its `gain`. An arc costs `there` if its tail stays and its
    head moves, and `back` if its head stays and its tail moves. SciPy needs sorted
    arcs, each with its reverse arc, even if that has no capacity. Nodes that the source
    reaches stay. The flow runs backwards, from the sink, beside which there are fewer
    nodes: that takes two thirds of the time, and those nodes are the same.
    """
    n_nodes = len(gain)
    sizes = np.abs(gain)
    largest = max(there.max(initial=0.0), sizes.max(initial=0.0))
    if largest <= 0:
        return np.zeros(n_nodes, dtype=bool)
    # An arc from the source is cut if a node moves that costs something. An arc to the
    # sink is cut if a node stays that would save something.
    source, sink = n_nodes, n_nodes + 1
    costly = gain > 0
    held, drawn = np.flatnonzero(costly), np.flatnonzero(~costly)
    # The arcs of a node come first, then the arc to the source or sink; these have the
    # highest numbers. Last come their own arcs. So all are sorted without a search.
    ends = np.cumsum(np.bincount(tails, minlength=n_nodes) + 1)
    inner, last = np.arange(len(tails)) + tails, ends - 1
    first = len(inner) + n_nodes
    starts = np.zeros(n_nodes + 3, dtype=np.int32)
    starts[1:-2], starts[-2:] = ends, (first + len(held), first + n_nodes)
    from_source, from_sink = slice(*starts[-3:-1]), slice(*starts[-2:])
    all_heads = np.empty(starts[-1], dtype=np.int32)
    all_heads[inner], all_heads[last] = heads, np.where(costly, source, sink)
    all_heads[from_source], all_heads[from_sink] = held, drawn

    unit = largest / _LARGEST_CAPACITY
    there, back, sizes = (np.rint(costs / unit) for costs in (there, back, sizes))
    forwards, backwards = np.zeros((2, len(all_heads)), dtype=np.int32)
    forwards[inner], backwards[inner] = there, back
    forwards[last], backwards[last] = sizes * ~costly, sizes * costly
    forwards[from_source], backwards[from_sink] = sizes[held], sizes[drawn]
    shape = n_nodes + 2, n_nodes + 2
    graph = sparse.csr_array((backwards, all_heads, starts), shape)
    flow = maximum_flow(graph, sink, source, method="dinic").flow
    left = forwards + flow.data > 0
    rest = np.zeros(len(left) + 1, dtype=np.int32)
    np.cumsum(left, out=rest[1:])
    return ~_reached(all_heads[left], rest[starts], source)[:n_nodes]


def _reached(heads: Int32Array, starts: Int32Array, start: int) -> BoolArray:
    """Return which nodes a walk from one reaches along arcs, (N,).

    The arcs of each node begin at `starts`, (N + 1,).
    """
    n_nodes = len(starts) - 1
    # Weights that SciPy need not convert.
    graph = sparse.csr_array((np.ones(len(heads)), heads, starts), (n_nodes, n_nodes))
    found = np.zeros(n_nodes, dtype=bool)
    found[breadth_first_order(graph, start, return_predecessors=False)] = True
    return found
