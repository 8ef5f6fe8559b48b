"""Pairs of samples counted by part: convexity ranks (eq. 1) and psi (eq. 5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..steps.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class PairTally:
    """Numbers of ordered pairs of samples between every two of K parts.

    Attributes
    ----------
    visible, known : (K, K) float
        Number of pairs in line of sight, and of all pairs that were tested.
    """

    visible: FloatArray
    known: FloatArray

    def ranks(self) -> FloatArray:
        """Return the convexity rank of each part (eq. 1), 1 if no pair is known.

        Returns
        -------
        ranks : (K,) float
        """
        visible, known = np.diag(self.visible), np.diag(self.known)
        return np.divide(visible, known, out=np.ones(len(known)), where=known > 0)

    def psi(self, alpha: float) -> float:
        """Return psi, the quality of the parts (eq. 5).

        It is the number of visible pairs within parts plus `alpha` times the number of
        hidden pairs between parts, divided by the number of all pairs.

        Parameters
        ----------
        alpha : float

        Returns
        -------
        psi : float
        """
        hidden = self.known - self.visible
        across = hidden.sum() - np.trace(hidden)
        return float((np.trace(self.visible) + alpha * across) / self.known.sum())

    def merge_gains(self, alpha: float) -> FloatArray:
        """Return how much psi gains when two parts become one, −inf on the diagonal.

        Each visible ordered pair between the two then adds 1; hidden ones no longer add
        `alpha`. Psi is the Constant Potts Model of resolution alpha / (1 + alpha).

        Parameters
        ----------
        alpha : float

        Returns
        -------
        gains : (K, K) float
        """
        gains = 2 * (self.visible - alpha * (self.known - self.visible))
        np.fill_diagonal(gains, -np.inf)
        return gains / self.known.sum()

    def merged(self, kept: int, gone: int) -> PairTally:
        """Return the tally of K − 1 parts after part `gone` is merged into part `kept`.

        Parameters
        ----------
        kept, gone : int

        Returns
        -------
        PairTally
        """
        counts = []
        for matrix in (self.visible, self.known):
            rows = matrix.copy()
            rows[kept] += rows[gone]
            rows[:, kept] += rows[:, gone]
            counts.append(np.delete(np.delete(rows, gone, axis=0), gone, axis=1))
        return PairTally(*counts)
