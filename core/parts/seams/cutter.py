"""Cuts the seams of parts as smoothly as psi allows, and makes them symmetric."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.spatial.distance import cdist

from ...clusters.moves import MoveGains
from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.memo import Memo, digest
from ...steps.progress import Progress, Steps, within
from ...steps.rows import blocks
from ..merging.pieces import connected_parts
from ..part_memo import SeamsKey
from ..part_psi import count_parts
from ..partition import Partitioner
from .graph_cut import SWEEPS, cut_seams
from .smoothing import smooth_seams

# Largest cost of a label for a sample.
_MOST_DISLIKE = 4.0
# Shares of lambda that are tried in turn, until the seams cost little enough psi.
_SOFTER = (1.0, 0.25, 0.0625)
# A part has ragged seams if more than this share of its area is in ragged ones.
_MOSTLY = 0.5
# Sweeps of the cut that smooths them: a second one hardly makes them shorter.
_SWEEPS = 1


class Seams(NamedTuple):
    """Parts with their seams cut.

    Attributes
    ----------
    parts : (P,) int
        Part of each node.
    smoothness : float
        The lambda that seams are cut with, 0 if none are.
    ragged : (P,) bool or None
        Nodes of parts that have their ragged seams still, as the cut would have removed
        them or cost too much psi; None if there are none.
    """

    parts: IntArray
    smoothness: float = 0.0
    ragged: BoolArray | None = None


class SeamCutter:
    """Cuts the seams of parts (eq. 4).

    Parameters
    ----------
    partitioner : Partitioner
        The partitioner that made the parts; its parameters are used.
    sweeps : int, optional
        Largest number of sweeps of a cut over all parts.
    rough : bool, optional
        Whether a first look is enough: seams are not made symmetric to the mirror
        plane.
    """

    def __init__(
        self,
        partitioner: Partitioner,
        sweeps: int = SWEEPS,
        *,
        rough: bool = False,
    ) -> None:
        self._partitioner, self._sweeps = partitioner, sweeps
        self._even = partitioner.by_psi and not rough
        self._smoothness = partitioner.parameters.smoothness
        found = partitioner.found
        self._memo: Memo[SeamsKey, Seams] = found.looks if rough else found.seams

    def cut(self, parts: IntArray, enough: float | None = None) -> Steps[Seams]:
        """Return the parts with smooth seams; their number stays the same.

        Smooth seams cost psi. If a part would become too small, its nodes keep their
        labels.

        Parameters
        ----------
        parts : (P,) int
            Part of each node, in 0…K − 1.
        enough : float, optional
            Least psi. By default seams cost at most what the moves of samples gained
            over k-means, or the sampling error.

        Returns
        -------
        Steps of Seams
        """
        key = self._smoothness, enough, digest(parts)
        return self._memo.recall_steps(key, lambda: self._cut(parts, enough))

    def _cut(self, parts: IntArray, enough: float | None) -> Steps[Seams]:
        """Return the parts with smooth seams."""
        n_parts, partitioner = count_parts(parts), self._partitioner
        if n_parts == 1 or self._smoothness == 0:
            return Seams(parts)
        if not partitioner.by_psi:
            enough = -np.inf
        elif enough is None:
            enough = min(
                partitioner.psi(partitioner.plain(n_parts)),
                partitioner.psi(parts) - partitioner.sampling_error,
            )
        costs = yield from within(self._costs_of_nodes(parts, n_parts), 0.0, 0.0)
        yield Progress("Seams", 0.0)
        for share in _SOFTER:
            weight = share * self._smoothness
            steps = cut_seams(partitioner.graph, parts, costs, weight, self._sweeps)
            cut, lost = self._none_lost((yield from within(steps, 0.0, 0.9)), parts)
            yield Progress("Seams", 0.9)
            cut = partitioner.tidied(cut, n_parts)
            if count_parts(cut) == n_parts and partitioner.psi(cut) >= enough:
                cut = yield from within(self._evened(cut, enough), 0.9, 1.0)
                return Seams(cut, weight, lost[parts] if lost.any() else None)
        # All cuts cost too much psi: seams stay near where they are.
        return Seams(parts, self._smoothness, np.ones(len(parts), dtype=bool))

    def smoothed(self, seams: Seams) -> Steps[Seams]:
        """Return parts whose ragged seams are smooth, too, near where they are."""
        parts, smoothness, ragged = seams
        if ragged is None:
            return seams
        key = smoothness, None, digest(parts) + digest(ragged)
        steps = partial(self._smoothed, parts, smoothness, ragged)
        return (yield from self._memo.recall_steps(key, steps))

    def _smoothed(
        self, parts: IntArray, smoothness: float, ragged: BoolArray
    ) -> Steps[Seams]:
        """Return parts whose seams are smooth where nodes are ragged, too."""
        graph, n_parts = self._partitioner.graph, count_parts(parts)
        areas = np.bincount(parts, graph.areas * ragged)
        chosen = np.flatnonzero(areas > _MOSTLY * graph.areas_of(parts))
        for share in _SOFTER:
            weight = share * smoothness
            steps = smooth_seams(graph, parts, chosen.tolist(), weight, _SWEEPS)
            smooth = yield from within(steps, 0.0, 0.9)
            yield Progress("Seams", 0.9)
            smooth, _ = self._none_lost(smooth, parts)
            yield Progress("Seams", 0.9)
            # A part that is torn in two, where it is narrow, makes one part more.
            smooth = connected_parts(graph, smooth, self._partitioner.smallest_area)
            if count_parts(smooth) == n_parts:
                smooth = yield from within(self._evened(smooth, -np.inf), 0.9, 1.0)
                return Seams(smooth, smoothness)
        return Seams(parts, smoothness)

    def _none_lost(self, cut: IntArray, parts: IntArray) -> tuple[IntArray, BoolArray]:
        """Return the cut labels (P,), where parts are lost those of `parts`.

        Return which parts these are, too, (K,). A part is lost if none of its pieces is
        large enough. One that comes back may take what another needs, so that it comes
        back too.
        """
        graph, smallest = self._partitioner.graph, self._partitioner.smallest_area
        n_parts = count_parts(parts)
        labels, lost = cut, np.zeros(n_parts, dtype=bool)
        while True:
            pieces = graph.pieces(labels, smallest)
            areas, of_pieces = graph.areas_of(pieces), np.zeros(n_parts)
            label_of = np.zeros(len(areas), dtype=np.int64)
            label_of[pieces] = labels
            np.maximum.at(of_pieces, label_of, areas)
            more = (of_pieces <= smallest) & ~lost
            if not more.any():
                return labels, lost
            lost |= more
            labels = np.where(lost[parts], parts, cut)

    def _evened(self, parts: IntArray, enough: float) -> Steps[IntArray]:
        """Return parts symmetric to the mirror plane, if psi is still high enough."""
        if not self._even:
            return parts
        wanted = {count_parts(parts)}
        return (yield from self._partitioner.evened(parts, wanted, enough))

    def _costs_of_nodes(self, parts: IntArray, n_parts: int) -> Steps[FloatArray]:
        """Return the data term of eq. 4 for each node, (P, K)."""
        transfer = self._partitioner.transfer
        of_samples = self._data_costs(transfer.to_samples(parts), n_parts)
        costs = np.empty((len(parts), n_parts))
        for rows in blocks(len(parts)):
            yield Progress("Seams", rows.start / len(parts))
            costs[rows] = transfer.shares[rows] @ of_samples
        return costs

    def _data_costs(self, labels: IntArray, n_labels: int) -> FloatArray:
        """Return the data term of eq. 4: the cost of each label per sample, (N, K)."""
        partitioner = self._partitioner
        if not partitioner.by_psi:
            return distances_to_parts(partitioner.embedding(n_labels), labels, n_labels)
        gains = MoveGains(partitioner.visibility.likely_pairs, labels, n_labels).of(
            slice(None), partitioner.parameters.alpha
        )
        return gains.max(axis=1, keepdims=True) - gains


def distances_to_parts(
    embedding: FloatArray, labels: IntArray, n_labels: int
) -> FloatArray:
    """Return the paper's data term of eq. 4: the cost of each label for each sample.

    It is the negative logarithm of a Gaussian of the distance, in the embedding,
    between the sample and the center of the label's samples, up to 4.

    Parameters
    ----------
    embedding : (N, n) float
        Coordinates of the samples in the embedding.
    labels : (N,) int
        Label of each sample, in 0…`n_labels` − 1, each used.
    n_labels : int
        Number of labels K.

    Returns
    -------
    costs : (N, K) float
        In 0…4, without unit.
    """
    members = np.eye(n_labels)[labels]
    sizes = np.maximum(members.sum(axis=0), 1.0)
    centers = (members.T @ embedding) / sizes[:, None]
    squared = cdist(embedding, centers, "sqeuclidean")
    # One variance for all: with variances of their own, wide parts swallow narrow ones.
    variance = (members * squared).sum() / len(labels) + np.finfo(float).tiny
    return np.minimum(squared / (2 * variance), _MOST_DISLIKE)
