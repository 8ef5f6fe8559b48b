"""Samples that change their part when psi gains by it (eq. 5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..sight.pairs import Matrix, PairVisibility, members_of, sums_by_label

# Sweeps over all samples at most; most shapes settle within five.
_SWEEPS = 10
# Samples move in turns, those of one turn far apart on the surface.
_TURNS = 15


class MoveGains:
    """How much psi there is in giving samples to labels, as labels change.

    Parameters
    ----------
    pairs : PairVisibility
        Which samples see each other, of N.
    labels : (N,) int
        In 0…`n_labels` − 1.
    n_labels : int
    """

    def __init__(
        self, pairs: PairVisibility, labels: NDArray[np.int64], n_labels: int
    ) -> None:
        self._pairs = pairs
        self._members = members_of(labels, n_labels)
        # Counts are whole numbers, exact in float32 however they are added up.
        self._visible = self._sums(pairs.visible, labels)
        self._own = pairs.visible.diagonal()
        self._sizes = self._members.sum(axis=0)
        self._total = float(pairs.n_samples) ** 2
        if pairs.known is not None:
            self._known = self._sums(pairs.known, labels)
            self._own_known, self._total = pairs.known.diagonal(), pairs.known.sum()

    def _sums(self, matrix: Matrix, labels: NDArray[np.int64]) -> NDArray[np.float32]:
        """Return the sums of the columns of each label, (N, K): those of its rows."""
        sums = sums_by_label(matrix, labels, self._members.shape[1])
        return np.ascontiguousarray(sums.T)

    def of(self, rows: slice, alpha: float) -> NDArray[np.float64]:
        """Return the pulls of R samples.

        Parameters
        ----------
        rows : slice
            Of the samples that are asked for.
        alpha : float
            Of psi.

        Returns
        -------
        pulls : (R, K) float
            What psi would grow by for each unit of area that got the label, but for
            what does not depend on the label.
        """
        mine = self._members[rows]
        # A sample sees itself whatever its label is.
        visible = self._visible[rows] - mine * self._own[rows, None]
        if self._pairs.known is None:
            known = self._sizes - mine
        else:
            known = self._known[rows] - mine * self._own_known[rows, None]
        gains = (1 + alpha) * visible.astype(float) - alpha * known.astype(float)
        return 2 * len(self._members) * gains / self._total

    def give(self, samples: NDArray[np.int64], labels: NDArray[np.int64]) -> None:
        """Give samples to labels, (M,) int each."""
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
    """Return the labels after every move of one sample by which psi gains.

    k-means knows nothing of psi. Psi is the Constant Potts Model of community detection
    at resolution alpha / (1 + alpha), for which such local moves are standard.

    Parameters
    ----------
    pairs : PairVisibility
        Which samples see each other, of N.
    labels : (N,) int
        In 0…`n_labels` − 1.
    n_labels : int
    alpha : float
        Of psi.

    Returns
    -------
    labels : (N,) int
        Those of `n_labels` that psi is better without are not used any more.
    """
    labels = labels.copy()
    samples = np.arange(len(labels))
    pulls = MoveGains(pairs, labels, n_labels)
    settled = 0
    for turn in range(_SWEEPS * _TURNS):
        asked = slice(turn % _TURNS, None, _TURNS)
        turns, here = pulls.of(asked, alpha), labels[asked]
        best, rows = turns.argmax(axis=1), samples[: len(here)]
        better = turns[rows, best] > turns[rows, here]
        moved = samples[asked][better]
        if len(moved):
            labels[moved] = best[better]
            pulls.give(moved, labels[moved])
        settled = 0 if len(moved) else settled + 1
        if settled == _TURNS:
            break
    return labels
