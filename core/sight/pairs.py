"""Convexity rank (eq. 1) and psi (eq. 5), from all pairs of samples or from some."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

Matrix: TypeAlias = NDArray[np.float32] | sparse.csr_array


def members_of(labels: NDArray[np.int64], n_labels: int) -> NDArray[np.float32]:
    """Return 1 where a sample has a label and 0 elsewhere, (N, `n_labels`)."""
    return np.eye(n_labels, dtype=np.float32)[labels]


def sums_by_label(
    matrix: Matrix | NDArray[np.float64], labels: NDArray[np.int64], n_labels: int
) -> NDArray[Any]:
    """Return the sum of the rows of each label, (`n_labels`, N).

    Every row is read once, however many labels there are.
    """
    rows = np.arange(len(labels) + 1)
    ones = np.ones(len(labels), dtype=np.float32)
    members = sparse.csr_array((ones, labels, rows), shape=(len(labels), n_labels))
    sums = members.T @ matrix
    return sums.toarray() if sparse.issparse(sums) else sums


def pair_counts(
    first: NDArray[np.int64], second: NDArray[np.int64], n_samples: int
) -> sparse.csr_array:
    """Return how often each pair was named, either way round, (N, N) float32."""
    half = sparse.coo_array(
        (np.ones(len(first), dtype=np.float32), (first, second)),
        shape=(n_samples, n_samples),
    ).tocsr()
    return sparse.csr_array(half + half.T)


@dataclass(frozen=True, eq=False)
class PairVisibility:
    """What is known of which pairs of samples see each other.

    Attributes
    ----------
    visible : (N, N) float32 or sparse
        1 where a pair is in line of sight, 0 elsewhere; symmetric.
    known : (N, N) sparse, optional
        How often each pair was looked up; None when `visible` knows them all.
    """

    visible: Matrix
    known: sparse.csr_array | None

    @property
    def n_samples(self) -> int:
        """Number of samples N."""
        return int(self.visible.shape[0])

    def rank_of_all(self) -> tuple[float, float]:
        """Return the convexity rank of all samples (eq. 1), and its standard error.

        The rank is a mean over pairs: to first order its deviation is twice that of
        the mean visibility of a single sample (Hoeffding 1948). Samples are in the
        order of a curve along which they are stratified, so that this deviation shows
        between neighbors on it.
        """
        visible = np.asarray(self.visible.sum(axis=1), dtype=float).ravel()
        if self.known is None:
            known = np.full(self.n_samples, float(self.n_samples))
        else:
            known = np.asarray(self.known.sum(axis=1), dtype=float).ravel()
        rank = float(visible.sum() / known.sum())
        deviations = (visible - rank * known) / known.mean()
        variance = float((np.diff(deviations) ** 2).mean()) / 2
        return rank, 2 * float(np.sqrt(variance / self.n_samples))

    def tally(self, labels: NDArray[np.int64], n_labels: int) -> PairTally:
        """Count visible and known pairs between every two labels."""

        def counts(matrix: Matrix) -> NDArray[np.float64]:
            # Whole numbers: those of a row are exact in single precision.
            of_rows = sums_by_label(matrix, labels, n_labels).T
            return sums_by_label(of_rows.astype(np.float64), labels, n_labels)

        if self.known is None:
            sizes = np.bincount(labels, minlength=n_labels).astype(np.float64)
            return PairTally(counts(self.visible), sizes[:, None] * sizes)
        return PairTally(counts(self.visible), counts(self.known))

    def hidden(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return the pairs known not to see each other, each once."""
        if self.known is None:
            first, second = np.nonzero(np.triu(np.asarray(self.visible) == 0))
        else:
            first, second = sparse.triu(self.known - self.visible, 1).nonzero()
        return first, second

    def revealed(
        self, first: NDArray[np.int64], second: NDArray[np.int64]
    ) -> PairVisibility:
        """Return these pairs with some hidden ones in line of sight."""
        if self.known is None:
            visible = np.array(self.visible)
            visible[first, second] = visible[second, first] = 1.0
            return PairVisibility(visible, None)
        chosen = pair_counts(first, second, self.n_samples)
        return PairVisibility(
            sparse.csr_array(self.visible + self.known * chosen), self.known
        )


@dataclass(frozen=True, eq=False)
class PairTally:
    """Ordered pairs of samples, counted by the parts they lie in.

    Attributes
    ----------
    visible, known : (K, K) float
        Pairs in line of sight, and all pairs that were looked up.
    """

    visible: NDArray[np.float64]
    known: NDArray[np.float64]

    def ranks(self) -> NDArray[np.float64]:
        """Return the convexity rank of each part (eq. 1), 1 where nothing is known."""
        visible, known = np.diag(self.visible), np.diag(self.known)
        return np.divide(visible, known, out=np.ones(len(known)), where=known > 0)

    def psi(self, alpha: float) -> float:
        """Return the quality psi of the parts (eq. 5).

        Visible pairs within parts, plus `alpha` times hidden pairs across parts, as
        a share of all pairs.
        """
        hidden = self.known - self.visible
        across = hidden.sum() - np.trace(hidden)
        return float((np.trace(self.visible) + alpha * across) / self.known.sum())

    def merge_gains(self, alpha: float) -> NDArray[np.float64]:
        """Return how much psi gains when two parts become one, (K, K).

        Every ordered pair across the two stops to count when hidden and begins to
        when visible: psi is the Constant Potts Model of resolution
        alpha / (1 + alpha).
        """
        gains = 2 * (self.visible - alpha * (self.known - self.visible))
        np.fill_diagonal(gains, -np.inf)
        return gains / self.known.sum()

    def merged(self, kept: int, gone: int) -> PairTally:
        """Return the tally with part `gone` counted as part `kept`."""
        counts = []
        for matrix in (self.visible, self.known):
            rows = matrix.copy()
            rows[kept] += rows[gone]
            rows[:, kept] += rows[:, gone]
            counts.append(np.delete(np.delete(rows, gone, axis=0), gone, axis=1))
        return PairTally(*counts)
