"""Moves of samples to other labels, as long as psi rises (eq. 5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.labels import sums_by_label
from ..sight.pair_visibility import Matrix, PairVisibility

# Most sweeps over all samples. For most shapes, no sample moves after five.
_SWEEPS = 10
# Turns of a sweep. All samples of a turn move at once; they are far apart on the
# surface.
_TURNS = 15


class MoveGains:
    """How much psi gains when a sample moves to each label, kept up to date.

    Parameters
    ----------
    pairs : PairVisibility
        Which of the N samples see each other.
    labels : (N,) int
        Current label of each sample, in 0…`n_labels` − 1.
    n_labels : int
        Number of labels K.
    """

    def __init__(
        self, pairs: PairVisibility, labels: NDArray[np.int64], n_labels: int
    ) -> None:
        self._pairs = pairs
        self._members = np.eye(n_labels, dtype=np.float32)[labels]
        # Multiples of a power of 2: their float32 sums are exact in any order.
        self._visible = self._sums(pairs.visible, labels)
        self._own = pairs.visible.diagonal()
        self._sizes = self._members.sum(axis=0)
        self._total = float(pairs.n_samples) ** 2
        if pairs.known is not None:
            self._known = self._sums(pairs.known, labels)
            self._own_known, self._total = pairs.known.diagonal(), pairs.known.sum()

    def _sums(self, matrix: Matrix, labels: NDArray[np.int64]) -> NDArray[np.float32]:
        """Return the sum of each row over the columns of each label, (N, K)."""
        sums = sums_by_label(matrix, labels, self._members.shape[1])
        return np.ascontiguousarray(sums.T)

    def of(self, rows: slice, alpha: float) -> NDArray[np.float64]:
        """Return the gain in psi of every label for R samples.

        Parameters
        ----------
        rows : slice
            Selects the R samples.
        alpha : float
            Weight of hidden pairs between parts in psi.

        Returns
        -------
        gains : (R, K) float
            Gain in psi if the sample has the label, per unit of area; the whole surface
            has area 1. A term that is the same for all labels of a sample is left out.
        """
        mine = self._members[rows]
        # Leave out the sample itself: it sees itself under any label.
        visible = self._visible[rows] - mine * self._own[rows, None]
        if self._pairs.known is None:
            known = self._sizes - mine
        else:
            known = self._known[rows] - mine * self._own_known[rows, None]
        gains = (1 + alpha) * visible.astype(float) - alpha * known.astype(float)
        return 2 * len(self._members) * gains / self._total

    def give(self, samples: NDArray[np.int64], labels: NDArray[np.int64]) -> None:
        """Change the labels of some samples and update the gains.

        Parameters
        ----------
        samples : (M,) int
            Rows of the samples.
        labels : (M,) int
            New label of each.
        """
        change = -self._members[samples]
        change[np.arange(len(samples)), labels] += 1
        self._members[samples] += change
        self._sizes += change.sum(axis=0)
        self._visible += self._pairs.visible[samples].T @ change
        if self._pairs.known is not None:
            self._known += self._pairs.known[samples].T @ change


def raise_psi(
    pairs: PairVisibility, labels: NDArray[np.int64], n_labels: int, alpha: float
) -> NDArray[np.int64]:
    """Move samples to the label that raises psi most.

    k-means does not optimize psi. Psi is the Constant Potts Model of community
    detection at resolution alpha / (1 + alpha), for which such local moves are
    standard. Samples of one turn move at once, and the gain of each leaves out the
    moves of the others; it stops when no sample gains by a move of its own, or after
    10 sweeps.

    Parameters
    ----------
    pairs : PairVisibility
        Which of the N samples see each other.
    labels : (N,) int
        Labels to start from, in 0…`n_labels` − 1.
    n_labels : int
        Number of labels K.
    alpha : float
        Weight of hidden pairs between parts in psi.

    Returns
    -------
    labels : (N,) int
        Some labels may be unused: all their samples have moved away.
    """
    labels = labels.copy()
    samples = np.arange(len(labels))
    gains = MoveGains(pairs, labels, n_labels)
    settled = 0
    for turn in range(_SWEEPS * _TURNS):
        asked = slice(turn % _TURNS, None, _TURNS)
        by_label, here = gains.of(asked, alpha), labels[asked]
        best, rows = by_label.argmax(axis=1), samples[: len(here)]
        better = by_label[rows, best] > by_label[rows, here]
        moved = samples[asked][better]
        if len(moved):
            labels[moved] = best[better]
            gains.give(moved, labels[moved])
        settled = 0 if len(moved) else settled + 1
        if settled == _TURNS:
            break
    return labels
