"""Splits a surface into k connected parts by the visibility of its samples."""

from __future__ import annotations

from collections.abc import Container
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..clusters.kmeans import cluster
from ..clusters.moves import raise_psi
from ..geometry.symmetry import Side
from ..parameters.parts import Parameters
from ..sight.pair_tally import PairTally
from ..sight.pair_visibility import PairVisibility
from ..steps.memo import digest
from ..steps.progress import Progress, Steps
from .merging.pieces import connected_parts, merge_to
from .part_memo import Candidate, PartMemo

# Weight of positions (in diagonals) relative to coordinates of the embedding.
_PLACE_WEIGHT = 1e-3
# If k clusters make fewer than k parts, try so many additional clusters, in turn.
_MORE_CLUSTERS = (0, 1, 2, 4, 8)
# Sampling error of psi, times √N: with other N samples, the psi of a shape differs by
# about twice this over √N.
_NEGLIGIBLE = 0.1


class Partitioner:
    """Splits a shape into connected parts, for any number of parts k.

    Parameters
    ----------
    memo : PartMemo
        The visibility; it also keeps intermediate results.
    parameters : Parameters

    Attributes
    ----------
    visibility : Visibility
    transfer : Transfer
    graph : FaceGraph
        Graph of the nodes that get labels.
    by_psi : bool
        Whether parts and seams are refined by psi.
    negligible : float
        Differences of psi below this are sampling error.
    smallest_area : float
        Connected pieces below this area, in squared diagonals, join a neighbor.
    """

    def __init__(self, memo: PartMemo, parameters: Parameters) -> None:
        self.parameters = parameters
        self.visibility = memo.visibility
        self.transfer = memo.transfer
        self.graph = self.transfer.graph
        self.by_psi = parameters.refinement == "PSI"
        self.negligible = _NEGLIGIBLE / np.sqrt(len(memo.visibility.samples))
        self.smallest_area = parameters.smallest_part * self.graph.areas.sum()
        self._memo = memo
        self._cut = memo.cut(parameters)
        self._of_clusters = memo.clusters(parameters)

    def candidate(self, n_parts: int) -> Candidate:
        """Return `n_parts` parts and their psi; fewer parts if no more are possible."""

        def make() -> Candidate:
            parts = self.partition(n_parts)
            return Candidate(parts, self.psi(parts))

        return self._cut.candidates.recall(n_parts, make)

    def better(self, n_parts: int, most: int) -> Candidate:
        """Return the best of the candidate and of merged candidates with more parts.

        With more clusters, k-means may find a part that it misses with fewer.

        Parameters
        ----------
        n_parts : int
        most : int
            Largest number of parts to merge from.

        Returns
        -------
        Candidate
        """
        own = self.candidate(n_parts)
        if n_parts >= most or not self.by_psi:
            return own

        def make() -> Candidate:
            merged = self.merged(self.better(n_parts + 1, most).parts, n_parts)
            found = Candidate(merged, self.psi(merged))
            few = count_parts(own.parts) < n_parts
            return found if few or found.psi > own.psi else own

        return self._cut.merged.recall((n_parts, most), make)

    def symmetric(
        self, parts: NDArray[np.int64], wanted: Container[int]
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
        sides = yield from self._memo.sides()
        found, key = [], digest(parts) if sides else b""
        for number, side in enumerate(sides):
            yield Progress("Symmetry", 0.0)
            make = partial(self._mirrored, parts, side)
            even = self._cut.even.recall((number, key), make)
            if count_parts(even) in wanted:
                found.append(Candidate(even, self.psi(even), True))
        return found

    def _mirrored(self, parts: NDArray[np.int64], side: Side) -> NDArray[np.int64]:
        """Return the parts after those on one side are copied to the other side."""
        return self._pieces(side.copied(parts, self.graph))

    def tally(self, parts: NDArray[np.int64]) -> PairTally:
        """Count likely and known pairs of samples by parts (P,) of the nodes."""
        return self._counted(self.visibility.likely_pairs, parts)

    def _counted(self, pairs: PairVisibility, parts: NDArray[np.int64]) -> PairTally:
        """Count pairs of samples by parts (P,) of the nodes, each kind once."""
        labels, n_parts = self.transfer.to_samples(parts), count_parts(parts)
        key = digest(labels), n_parts, pairs is self.visibility.psi_pairs
        return self._memo.tallies.recall(key, lambda: pairs.tally(labels, n_parts))

    def psi(self, parts: NDArray[np.int64]) -> float:
        """Return psi (eq. 5) of parts (P,) of the nodes, from likely pairs."""
        return self.tally(parts).psi(self.parameters.alpha)

    def psi_seen(self, parts: NDArray[np.int64]) -> float:
        """Return psi (eq. 5) of parts (P,) of the nodes, from lines of sight alone."""
        tally = self._counted(self.visibility.psi_pairs, parts)
        return tally.psi(self.parameters.alpha)

    def partition(self, n_parts: int) -> NDArray[np.int64]:
        """Return `n_parts` connected parts; fewer if no more are possible.

        Parameters
        ----------
        n_parts : int

        Returns
        -------
        parts : (P,) int
            Part of each node, in 0…K − 1.
        """
        plain = self.plain(n_parts)
        if n_parts == 1 or not self.by_psi:
            return plain
        n_clusters, labels = self._clusters(n_parts, n_parts)
        pairs, alpha = self.visibility.likely_pairs, self.parameters.alpha
        raised = self._memo.moves.recall(
            (digest(labels), alpha),
            lambda: raise_psi(pairs, labels, n_clusters, alpha),
        )
        parts = self.tidied(self._on_nodes(raised, n_clusters), n_parts)
        # Psi may be higher with fewer parts: split those where psi loses least.
        moved = self._split(parts, n_parts)
        return max(
            moved, plain, key=lambda parts: (count_parts(parts), self.psi(parts))
        )

    def plain(self, n_parts: int) -> NDArray[np.int64]:
        """Return `n_parts` connected parts (P,) from k-means, not refined by psi."""
        whole = np.zeros(self.graph.n_polygons, dtype=np.int64)
        return self._cut.plain.recall(n_parts, lambda: self._split(whole, n_parts))

    def _split(self, parts: NDArray[np.int64], n_parts: int) -> NDArray[np.int64]:
        """Split parts along the borders of k-means' clusters, up to `n_parts` parts."""
        most = parts
        for more in _MORE_CLUSTERS:
            if count_parts(most) >= n_parts:
                break
            n_clusters, labels = self._clusters(n_parts + more, n_parts)
            clusters = self._on_nodes(labels, n_clusters)
            finer = parts * n_clusters + clusters
            pieces = self._memo.pieces.recall(
                (self.smallest_area, digest(finer)), partial(self._pieces, finer)
            )
            split = self._at_most(n_parts, pieces)
            if count_parts(split) > count_parts(most):
                most = split
        return most

    def _on_nodes(self, labels: NDArray[np.int64], n_labels: int) -> NDArray[np.int64]:
        """Return labels (N,) of the samples carried to the nodes, (P,)."""
        return self._memo.on_nodes.recall(
            digest(labels), lambda: self.transfer.to_polygons(labels, n_labels)
        )

    def _clusters(self, n_clusters: int, n_parts: int) -> tuple[int, NDArray[np.int64]]:
        """Return the number of clusters and the labels (N,) of samples by k-means."""
        n_clusters = min(n_clusters, len(self.visibility.samples))
        embedding = self.embedding(n_parts)[:, :n_clusters]

        def make() -> NDArray[np.int64]:
            # Positions separate samples that see the same, as in a convex shape.
            places = _PLACE_WEIGHT * self.visibility.samples.positions
            coordinates = np.hstack([embedding, places])
            return cluster(coordinates, n_clusters, self.parameters.seed)

        key = n_clusters, embedding.shape[1]
        return n_clusters, self._of_clusters.recall(key, make)

    def embedding(self, n_parts: int) -> NDArray[np.float64]:
        """Return the embedding of the samples for `n_parts` parts, (N, n) float."""
        return self._memo.embedding(n_parts, self.parameters)

    def tidied(self, labels: NDArray[np.int64], n_parts: int) -> NDArray[np.int64]:
        """Return connected parts (P,), merged down to `n_parts` if there are more."""
        return self._at_most(n_parts, self._pieces(labels))

    def _pieces(self, labels: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the connected pieces of labels, without pieces that are too small."""
        return connected_parts(self.graph, labels, self.smallest_area)

    def _at_most(self, n_parts: int, parts: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the parts, merged down to `n_parts` if there are more."""
        return parts if count_parts(parts) <= n_parts else self.merged(parts, n_parts)

    def resized(self, parts: NDArray[np.int64], n_parts: int) -> NDArray[np.int64]:
        """Return parts (P,) split or merged so that there are `n_parts`."""
        return self._at_most(n_parts, self._split(parts, n_parts))

    def merged(self, parts: NDArray[np.int64], n_parts: int) -> NDArray[np.int64]:
        """Merge parts (P,) where psi loses least, until `n_parts` are left."""
        borders = self.graph.borders(parts, count_parts(parts)).toarray()
        alpha = self.parameters.alpha
        return merge_to(n_parts, self.tally(parts), borders, alpha)[parts]


def count_parts(parts: NDArray[np.int64]) -> int:
    """Return the number of parts K of labels (P,) in 0…K − 1."""
    return int(parts.max()) + 1
