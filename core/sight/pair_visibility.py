"""Which pairs of samples see each other, of all pairs or of some."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from scipy import sparse

from ..geometry.labels import sums_by_label
from ..steps.arrays import Float32Array, IntArray
from .pair_tally import PairTally

Matrix: TypeAlias = Float32Array | sparse.csr_array


def pair_counts(first: IntArray, second: IntArray, n_samples: int) -> sparse.csr_array:
    """Return how often each pair of N samples occurs in a list, in either order.

    Parameters
    ----------
    first, second : (M,) int in 0…N − 1
    n_samples : int

    Returns
    -------
    counts : (N, N) sparse float32
        Symmetric. A sample paired with itself counts twice.
    """
    half = sparse.coo_array(
        (np.ones(len(first), dtype=np.float32), (first, second)),
        shape=(n_samples, n_samples),
    ).tocsr()
    return sparse.csr_array(half + half.T)


@dataclass(frozen=True, eq=False)
class PairVisibility:
    """Which pairs of samples see each other, as far as it is known.

    Attributes
    ----------
    visible : (N, N) float32 or sparse
        How often each pair was tested and visible; 0 or 1 if tested once. Likely pairs
        hold the probability of one part instead, from 0 to 1. Symmetric.
    known : (N, N) sparse or None
        How often each pair was tested. None if all pairs have one answer.
    n_cast : int
        Number of pairs that rays were cast between. Other pairs need none: they do not
        face each other through the inside.
    n_inferred : int
        Number of pairs whose answer is that of similar pairs.
    """

    visible: Matrix
    known: sparse.csr_array | None
    n_cast: int = 0
    n_inferred: int = 0

    @property
    def n_samples(self) -> int:
        """Number of samples N."""
        return int(self.visible.shape[0])

    def rank_of_all(self) -> tuple[float, float]:
        """Return the convexity rank of all samples (eq. 1) and its standard error.

        To first order, the deviation of a mean over pairs is twice that of the mean
        visibility per sample (Hoeffding 1948). Samples are stratified along a curve and
        sorted by it, so differences of neighbors on it estimate this deviation.

        Returns
        -------
        rank, error : float
        """
        sums = self.sums(np.zeros(self.n_samples, dtype=np.int64), 1)
        visible, known = np.concatenate(sums).astype(np.float64)
        rank = float(visible.sum() / known.sum())
        deviations = (visible - rank * known) / known.mean()
        variance = float((np.diff(deviations) ** 2).mean()) / 2
        return rank, 2 * float(np.sqrt(variance / self.n_samples))

    def sums(
        self, labels: IntArray, n_labels: int
    ) -> tuple[Float32Array, Float32Array]:
        """Count visible and known pairs of each sample with those of each of K labels.

        Parameters
        ----------
        labels : (N,) int in 0…K − 1
        n_labels : int

        Returns
        -------
        visible, known : (K, N) float32
            Exact in any order of adding: they add up multiples of a power of 2.
        """
        visible = sums_by_label(self.visible, labels, n_labels)
        if self.known is not None:
            return visible, sums_by_label(self.known, labels, n_labels)
        sizes = np.bincount(labels, minlength=n_labels).astype(np.float32)
        return visible, np.broadcast_to(sizes[:, None], visible.shape)

    def tally(self, labels: IntArray, n_labels: int) -> PairTally:
        """Count visible and known pairs of samples between every two of K labels.

        Parameters
        ----------
        labels : (N,) int in 0…K − 1
        n_labels : int

        Returns
        -------
        PairTally
        """
        # The product is exact, as the sums are.
        members = np.eye(n_labels)[labels]
        visible, known = (
            of_labels.astype(np.float64) @ members
            for of_labels in self.sums(labels, n_labels)
        )
        return PairTally(visible, known)

    def hidden(self) -> tuple[IntArray, IntArray]:
        """Return the pairs that are known to be hidden, each once.

        Returns
        -------
        first, second : (M,) int rows of samples
        """
        if self.known is None:
            first, second = np.nonzero(np.triu(np.asarray(self.visible) == 0))
        else:
            first, second = sparse.triu(self.known - self.visible, 1).nonzero()
        return first, second

    def revealed(self, first: IntArray, second: IntArray) -> PairVisibility:
        """Return a copy in which some hidden pairs are visible.

        Parameters
        ----------
        first, second : (M,) int rows of samples, each pair once

        Returns
        -------
        PairVisibility
        """
        if self.known is None:
            visible = np.array(self.visible)
            visible[first, second] = visible[second, first] = 1.0
            return replace(self, visible=visible)
        chosen = pair_counts(first, second, self.n_samples)
        more = sparse.csr_array(self.visible + self.known * chosen)
        return replace(self, visible=more)
