"""Moves of samples to other labels, as long as psi rises (eq. 5)."""

from __future__ import annotations

import numpy as np

from ..sight.pair_visibility import PairVisibility
from ..steps.arrays import FloatArray, IntArray

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

    def __init__(self, pairs: PairVisibility, labels: IntArray, n_labels: int) -> None:
        self._pairs = pairs
        self._members = np.eye(n_labels, dtype=np.float32)[labels]
        visible, known = pairs.sums(labels, n_labels)
        self._total = known.sum(dtype=np.float64)
        # If all pairs are known, all samples have one row.
        known = known[:, :1] if pairs.known is None else known
        self._visible, self._known = (
            np.array(counts.T, order="C") for counts in (visible, known)
        )
        self._own = pairs.visible.diagonal()
        self._own_known = (
            np.ones_like(self._own) if pairs.known is None else pairs.known.diagonal()
        )

    def of(self, rows: slice, alpha: float) -> FloatArray:
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
        known = self._known if self._pairs.known is None else self._known[rows]
        known = known - mine * self._own_known[rows, None]
        gains = (1 + alpha) * visible.astype(float) - alpha * known.astype(float)
        return 2 * len(self._members) * gains / self._total

    def give(self, samples: IntArray, labels: IntArray) -> None:
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
        visible, known = self._pairs.visible, self._pairs.known
        self._visible += visible[samples].T @ change
        self._known += (
            change.sum(axis=0) if known is None else known[samples].T @ change
        )


def raise_psi(
    pairs: PairVisibility, labels: IntArray, n_labels: int, alpha: float
) -> IntArray:
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
