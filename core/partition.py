"""Exactly k parts of a surface, connected and with clean seams."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .clustering import cluster
from .convexity import PairTally, members_of
from .graph_cut import cut_seams, distances_to_parts
from .moves import raise_psi
from .parameters import Parameters
from .progress import Steps
from .refinement import connected_parts, merge_to
from .visibility import Visibility

# Weight of positions, in diagonals, beside the embedding.
_PLACE_WEIGHT = 1e-3
# How many more clusters are tried when k of them make fewer than k parts.
_MORE_CLUSTERS = (0, 1, 2, 4, 8)
# Seams that would cost too much are cut again with these shares of lambda.
_SOFTER = (1.0, 0.5, 0.25, 0.125, 0.0625)


class Partitioner:
    """Makes parts of a shape from its visibility, for one k after the other.

    Parameters
    ----------
    visibility : Visibility
    parameters : Parameters
    """

    def __init__(self, visibility: Visibility, parameters: Parameters) -> None:
        self.visibility = visibility
        self.parameters = parameters
        self.transfer = visibility.transfer
        self.surface = visibility.transfer.surface
        self.embedding = visibility.embedding(parameters)
        self.by_psi = parameters.refinement == "PSI"
        self.smallest_area = parameters.smallest_part * self.surface.areas.sum()
        self._labels: dict[int, NDArray[np.int64]] = {}

    def tally(self, parts: NDArray[np.int64]) -> PairTally:
        """Return the pairs of samples counted by the parts of the polygons."""
        labels = self.transfer.to_samples(parts)
        return self.visibility.pairs.tally(labels, count(parts))

    def psi(self, parts: NDArray[np.int64]) -> float:
        """Return psi (eq. 5) of parts of the polygons."""
        return self.tally(parts).psi(self.parameters.alpha)

    def partition(self, n_parts: int) -> NDArray[np.int64]:
        """Return `n_parts` parts of the polygons, or as many as can be, (P,) int."""
        plain = self._plain(n_parts)
        if n_parts == 1 or not self.by_psi:
            return plain
        n_clusters, labels = self._clusters(n_parts)
        raised = raise_psi(
            self.visibility.pairs, labels, n_clusters, self.parameters.alpha
        )
        parts = self._tidied(self.transfer.to_polygons(raised, n_clusters), n_parts)
        # Psi may be better with fewer parts: they are split where it loses least.
        moved = self._split(parts, n_parts)
        return max(moved, plain, key=lambda parts: (count(parts), self.psi(parts)))

    def _plain(self, n_parts: int) -> NDArray[np.int64]:
        """Return the parts that k-means' clusters are, as they are."""
        whole = np.zeros(self.surface.n_polygons, dtype=np.int64)
        return self._split(whole, n_parts)

    def _split(self, parts: NDArray[np.int64], n_parts: int) -> NDArray[np.int64]:
        """Return parts split along k-means' clusters into `n_parts` connected ones."""
        most = parts
        for more in _MORE_CLUSTERS:
            if count(most) >= n_parts:
                break
            n_clusters, labels = self._clusters(n_parts + more)
            clusters = self.transfer.to_polygons(labels, n_clusters)
            split = self._tidied(parts * n_clusters + clusters, n_parts)
            if count(split) > count(most):
                most = split
        return most

    def _clusters(self, n_clusters: int) -> tuple[int, NDArray[np.int64]]:
        """Return the number of clusters of the samples, and their labels, (N,) int."""
        n_clusters = min(n_clusters, len(self.visibility.samples))
        if n_clusters in self._labels:
            return n_clusters, self._labels[n_clusters]
        # Samples that see the same, as in a convex shape, are told apart by place.
        coordinates = np.hstack(
            [
                self.embedding[:, :n_clusters],
                _PLACE_WEIGHT * self.visibility.samples.positions,
            ]
        )
        self._labels[n_clusters] = cluster(
            coordinates, n_clusters, self.parameters.seed
        )
        return n_clusters, self._labels[n_clusters]

    def seamed(self, parts: NDArray[np.int64]) -> Steps[NDArray[np.int64]]:
        """Return the same number of parts with their seams cut anew (eq. 4).

        Smooth seams cost psi: no more of it than its moves have won over k-means.
        """
        n_parts = count(parts)
        if n_parts == 1 or self.parameters.smoothness == 0:
            return parts
        enough = -np.inf
        if self.by_psi:
            enough = min(self.psi(self._plain(n_parts)), self.psi(parts))
        labels = self.transfer.to_samples(parts)
        costs = self.transfer.shares @ self._dislikes(labels, n_parts)
        for share in _SOFTER:
            cut = yield from cut_seams(
                self.surface, parts, costs, share * self.parameters.smoothness
            )
            cut = self._tidied(cut, n_parts)
            if count(cut) == n_parts and self.psi(cut) >= enough:
                return cut
        return parts

    def _dislikes(
        self, labels: NDArray[np.int64], n_labels: int
    ) -> NDArray[np.float64]:
        """Return the data term of eq. 4, how little samples like labels, (N, K)."""
        if not self.by_psi:
            return distances_to_parts(self.embedding, labels, n_labels)
        members = members_of(labels, n_labels)
        pulls = self.visibility.pairs.pulls(members, self.parameters.alpha)
        return pulls.max(axis=1, keepdims=True) - pulls

    def _tidied(self, labels: NDArray[np.int64], n_parts: int) -> NDArray[np.int64]:
        """Return at most `n_parts` parts, connected where that many allow it."""
        parts = connected_parts(self.surface, labels, self.smallest_area)
        return parts if count(parts) <= n_parts else self.merged(parts, n_parts)

    def merged(self, parts: NDArray[np.int64], n_parts: int) -> NDArray[np.int64]:
        """Return `n_parts` parts, merged from more where psi loses least."""
        n_pieces = count(parts)
        touching = self.surface.borders(parts, n_pieces).toarray() > 0
        merged = merge_to(n_parts, self.tally(parts), touching, self.parameters.alpha)
        return merged[parts]


def count(parts: NDArray[np.int64]) -> int:
    """Return the number of parts of labels 0…K − 1."""
    return int(parts.max()) + 1
