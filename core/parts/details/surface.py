"""Distances along the surface of one part, without a ray."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from ...geometry.graphs.face_graph import FaceGraph
from ...steps.arrays import BoolArray, FloatArray, IntArray


def roads(graph: FaceGraph, least: float = 0.0) -> sparse.csr_array:
    """Return the ways (P, P) between the centers of neighbors."""
    ends = graph.neighbors.T
    ways = np.linalg.norm(np.subtract(*graph.centers[ends]), axis=1)
    ways = np.maximum(ways, least or np.finfo(float).tiny)  # 0 would mean no way
    return sparse.csr_array((ways, tuple(ends)), shape=2 * (graph.n_polygons,))


def meetings(
    far: FloatArray, pairs: NDArray[np.integer[Any]]
) -> Iterator[tuple[int, int, int, BoolArray]]:
    """Yield where two hills meet, the highest places first; they are one from then on.

    Parameters
    ----------
    far : (P,) float
        Height of each node.
    pairs : (E, 2) int
        Neighbors.

    Yields
    ------
    lower, higher, between : int
        The top of the lower hill, that of the higher one, and the node between them.
    hill : (P,) bool
        Nodes of the lower hill.
    """
    tops, saddles = _hills(far, pairs)
    for one, other, between in saddles.tolist():
        low, high = sorted((int(tops[one]), int(tops[other])), key=far.__getitem__)
        if low != high:
            hill = tops == low
            yield low, high, between, hill
            tops[hill] = high


def _hills(
    far: FloatArray, pairs: NDArray[np.integer[Any]]
) -> tuple[IntArray, IntArray]:
    """Return the top that each node climbs to, (P,), and where hills meet, (S, 3).

    These are two tops and the node between them, the highest ones first.
    """
    order = np.argsort(far, kind="stable")
    ranks = np.empty_like(order)
    ranks[order] = np.arange(len(order))
    higher = ranks.copy()
    for one, other in (pairs.T, pairs.T[::-1]):
        np.maximum.at(higher, one, ranks[other])
    tops = order[higher]
    while (tops[tops] != tops).any():
        tops = tops[tops]
    ends = np.sort(tops[pairs], axis=1)
    levels = ranks[pairs].min(axis=1)
    rows = np.flatnonzero(ends[:, 0] != ends[:, 1])
    rows = rows[np.argsort(-levels[rows], kind="stable")]
    first = np.sort(np.unique(ends[rows], axis=0, return_index=True)[1])
    rows = rows[first]
    return tops, np.column_stack([ends[rows], order[levels[rows]]])


class PartSurface:
    """The surface of one part, and how far its nodes are from its seams.

    Parameters
    ----------
    graph : FaceGraph
        Of the whole shape.
    kept : (M,) int
        The nodes of the part.
    at_seams : (P,) bool
        Whether each node of the whole shape has a neighbor in another part.

    Attributes
    ----------
    graph : FaceGraph
        Of the part alone; its nodes are numbered in the order of `kept`.
    kept : (M,) int
    """

    def __init__(self, graph: FaceGraph, kept: IntArray, at_seams: BoolArray) -> None:
        self.graph, self.kept = graph.part(kept), kept
        self._starts = np.flatnonzero(at_seams[kept])
        self._roads = roads(self.graph)
        self._from: dict[int, FloatArray] = {}

    @cached_property
    def far(self) -> FloatArray:
        """(M,) distance of each node from the seams; 0 if there are none."""
        if len(self._starts) == 0:
            return np.zeros(len(self.kept))
        far = dijkstra(self._roads, directed=False, indices=self._starts, min_only=True)
        return np.where(np.isfinite(far), far, 0.0)

    def from_nodes(self, nodes: list[int]) -> list[FloatArray]:
        """Return the distances (M,) of all nodes from each of some; 0 without a way.

        Parameters
        ----------
        nodes : list of int
        """
        new = [node for node in nodes if node not in self._from]
        if new:
            ways = dijkstra(self._roads, directed=False, indices=new)
            ways[~np.isfinite(ways)] = 0.0
            self._from |= dict(zip(new, ways, strict=True))
        return [self._from[node] for node in nodes]

    def tips(self, least: float, most: int) -> list[int]:
        """Return the nodes that are farther from the seams than all around them.

        Parameters
        ----------
        least : float
            Going to a farther one, one has to come nearer to the seams by this much.
        most : int
            So many tips are returned at most, the clearest first.
        """
        over = {int(self.far.argmax()): float(self.far.max())}
        for tip, _, between, _ in meetings(self.far, self.graph.neighbors):
            over[tip] = float(self.far[tip] - self.far[between])
        clear = [tip for tip in over if over[tip] >= least]
        return sorted(clear, key=lambda tip: -over[tip])[:most]
