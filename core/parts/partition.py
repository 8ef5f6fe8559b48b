"""Splits a surface into k connected parts by the visibility of its samples."""

from __future__ import annotations

from collections.abc import Container, Sequence
from functools import partial

import numpy as np

from ..clusters.kmeans import cluster
from ..clusters.moves import raise_psi
from ..geometry.graphs.face_graph import FaceGraph
from ..geometry.symmetry import Side
from ..parameters.parts import Parameters
from ..steps.arrays import FloatArray, IntArray
from ..steps.memo import digest
from ..steps.progress import Progress, Steps, run
from .merging.pieces import connected_parts, merge_to
from .part_memo import Candidate, PartMemo
from .part_psi import PartPsi, count_parts

# Weight of positions (in diagonals) relative to coordinates of the embedding.
_PLACE_WEIGHT = 1e-3
# If k clusters make fewer than k parts, try so many additional clusters, in turn.
_TRIES = (0, 1, 2, 4, 8)


class Partitioner(PartPsi):
    """Splits a shape into connected parts, for any number of parts k.

    Parameters
    ----------
    memo : PartMemo
        The visibility; it also keeps intermediate results.
    parameters : Parameters

    Attributes
    ----------
    graph : FaceGraph
        Graph of the nodes that get labels.
    by_psi : bool
        Whether parts and seams are refined by psi.
    smallest_area : float
        Connected pieces below this area, in squared diagonals, join a neighbor.
    found : FoundMemo
        What is found with these parameters.
    """

    def __init__(self, memo: PartMemo, parameters: Parameters) -> None:
        super().__init__(memo, parameters)
        self.graph = self.transfer.graph
        self.by_psi = parameters.refinement == "PSI"
        self.smallest_area = parameters.smallest_part * self.graph.areas.sum()
        self.found = memo.found_with(parameters)

    def candidate(self, n_parts: int) -> Candidate:
        """Return `n_parts` parts and their psi; fewer parts if no more are possible."""

        def make() -> Candidate:
            parts = self.partition(n_parts)
            return Candidate(parts, self.psi(parts))

        return self.found.candidates.recall(n_parts, make)

    def symmetric(
        self, parts: IntArray, wanted: Container[int]
    ) -> Steps[list[Candidate]]:
        """Return the parts made symmetric, by copying either side to the other.

        Parameters
        ----------
        parts : (P,) int
        wanted : container of int
            Candidates with another number of parts are left out.

        Returns
        -------
        Steps of list of Candidate
            At most two, none if the shape has no mirror plane.
        """
        sides = yield from self.memo.sides()
        found, key = [], digest(parts) if sides else b""
        for number, side in enumerate(sides):
            yield Progress("Symmetry", 0.0)
            make = partial(self._mirrored, parts, side)
            even = self.found.even.recall((number, key), make)
            if count_parts(even) in wanted:
                found.append(Candidate(even, self.psi(even), True))
        return found

    def evened(
        self, parts: IntArray, wanted: Container[int], enough: float = -np.inf
    ) -> Steps[IntArray]:
        """Return symmetric parts, or the same ones if psi is clearly lower then.

        Parameters
        ----------
        parts : (P,) int
        wanted : container of int
            Numbers of parts that there may be.
        enough : float, optional
            Least psi.

        Returns
        -------
        Steps of (P,) int
        """
        even = yield from self.symmetric(parts, wanted)
        least = max(enough, self.psi(parts) - self.sampling_error)
        best = max(even, key=lambda each: each.psi, default=None)
        return parts if best is None or best.psi < least else best.parts

    def _mirrored(self, parts: IntArray, side: Side) -> IntArray:
        """Return the parts after those on one side are copied to the other side."""
        return self._pieces(side.copied(parts, self.graph))

    def partition(self, n_parts: int) -> IntArray:
        """Return `n_parts` connected parts (P,); fewer if no more are possible."""
        plain = self.plain(n_parts)
        if n_parts == 1 or not self.by_psi:
            return plain
        n_clusters, labels = self._clusters(n_parts, n_parts)
        pairs, alpha = self.visibility.likely_pairs, self.parameters.alpha
        raised = self.memo.moves.recall(
            (digest(labels), n_clusters, alpha),
            lambda: raise_psi(pairs, labels, n_clusters, alpha),
        )
        parts = self.tidied(self._on_nodes(raised, n_clusters), n_parts)
        # Psi may be higher with fewer parts: split those where psi loses least.
        moved = run(self._split_in_steps(parts, n_parts))
        return max(
            moved, plain, key=lambda parts: (count_parts(parts), self.psi(parts))
        )

    def plain(self, n_parts: int) -> IntArray:
        """Return `n_parts` connected parts (P,) from k-means, not refined by psi."""
        return run(self.plain_in_steps(n_parts))

    def plain_in_steps(self, n_parts: int) -> Steps[IntArray]:
        """Return the steps that end in `plain`."""
        whole = np.zeros(self.graph.n_polygons, dtype=np.int64)
        return self.found.plain.recall_steps(
            n_parts, lambda: self._split_in_steps(whole, n_parts)
        )

    def _split_in_steps(
        self, parts: IntArray, n_parts: int, tries: Sequence[int] = _TRIES
    ) -> Steps[IntArray]:
        """Split parts along the borders of k-means' clusters, up to `n_parts` parts."""
        most = parts
        for more in tries:
            if count_parts(most) >= n_parts:
                break
            yield Progress("Number of parts", 0.0)
            self.embedding(n_parts)  # takes as long as the clusters
            yield Progress("Number of parts", 0.0)
            n_clusters, labels = self._clusters(n_parts + more, n_parts)
            clusters = self._on_nodes(labels, n_clusters)
            finer = parts * n_clusters + clusters
            pieces = self.memo.pieces.recall(
                (self.smallest_area, digest(finer)), partial(self._pieces, finer)
            )
            split = self._at_most(n_parts, pieces)
            if count_parts(split) > count_parts(most):
                most = split
        return most

    def _on_nodes(self, labels: IntArray, n_labels: int) -> IntArray:
        """Return labels (N,) of the samples carried to the nodes, (P,)."""
        return self.memo.on_nodes.recall(
            (digest(labels), n_labels),
            lambda: self.transfer.to_polygons(labels, n_labels),
        )

    def _clusters(self, n_clusters: int, n_parts: int) -> tuple[int, IntArray]:
        """Return the number of clusters and the labels (N,) of samples by k-means."""
        n_clusters = min(n_clusters, len(self.visibility.samples))
        embedding = self.embedding(n_parts)[:, :n_clusters]

        def make() -> IntArray:
            # Positions separate samples that see the same, as in a convex shape.
            places = _PLACE_WEIGHT * self.visibility.samples.positions
            coordinates = np.hstack([embedding, places])
            return cluster(coordinates, n_clusters, seed)

        seed, kind = self.parameters.seed, self.parameters.normalization
        key = kind, seed, n_clusters, embedding.shape[1]
        return n_clusters, self.memo.clusters.recall(key, make)

    def embedding(self, n_parts: int) -> FloatArray:
        """Return the embedding of the samples for `n_parts` parts, (N, n) float."""
        return self.memo.embedding(n_parts, self.parameters)

    def tidied(self, labels: IntArray, n_parts: int) -> IntArray:
        """Return connected parts (P,), merged down to `n_parts` if there are more."""
        return self._at_most(n_parts, self._pieces(labels))

    def _pieces(self, labels: IntArray) -> IntArray:
        """Return the connected pieces of labels, without pieces that are too small."""
        return connected_parts(self.graph, labels, self.smallest_area)

    def _at_most(self, n_parts: int, parts: IntArray) -> IntArray:
        """Return the parts, merged down to `n_parts` if there are more."""
        return parts if count_parts(parts) <= n_parts else self.merged(parts, n_parts)

    def resized_in_steps(
        self,
        parts: IntArray,
        n_parts: int,
        most: int = 0,
        tries: Sequence[int] = _TRIES,
    ) -> Steps[IntArray]:
        """Return parts (P,) split or merged so that there are `n_parts`.

        Parameters
        ----------
        parts : (P,) int
        n_parts : int
        most : int, optional
            Split up to so many parts first, then merge them.
        tries : sequence of int, optional
            How many more clusters than parts to split by, in turn, until they do.

        Returns
        -------
        Steps of (P,) int
        """
        split = yield from self._split_in_steps(parts, max(n_parts, most), tries)
        return self._at_most(n_parts, split)

    def merged(
        self,
        parts: IntArray,
        n_parts: int,
        graph: FaceGraph | None = None,
        price: float = 0.0,
        *,
        further: bool = False,
    ) -> IntArray:
        """Merge parts (P,) where psi loses least, until `n_parts` are left.

        Borders may have a price, and be those of another graph; see `merge_to`. They
        merge `further` only across seams that cost more than they save.
        """
        borders = (graph or self.graph).borders(parts, count_parts(parts)).toarray()
        if further:
            borders = np.maximum(borders, 0.0)
        tally, alpha = self.tally(parts), self.parameters.alpha
        return merge_to(n_parts, tally, borders, alpha, price, further=further)[parts]
