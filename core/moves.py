"""Samples that change their part when psi gains by it (eq. 5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .convexity import KnownPairs, members_of

# Sweeps over all samples at most; most shapes settle within five.
_SWEEPS = 10
# Samples move in turns, those of one turn far apart on the surface.
_TURNS = 15


def raise_psi(
    pairs: KnownPairs, labels: NDArray[np.int64], n_labels: int, alpha: float
) -> NDArray[np.int64]:
    """Return the labels after every move of one sample by which psi gains.

    k-means knows nothing of psi. Psi is the Constant Potts Model of community detection
    at resolution alpha / (1 + alpha), for which such local moves are standard.

    Parameters
    ----------
    pairs : KnownPairs
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
    members = members_of(labels, n_labels)
    for _ in range(_SWEEPS):
        before = labels.copy()
        for turn in range(_TURNS):
            rows = slice(turn, None, _TURNS)
            pulls = pairs.pulls(members, alpha, rows)
            best, here = pulls.argmax(axis=1), labels[rows]
            better = pulls.max(axis=1) > pulls[np.arange(len(here)), here]
            labels[rows] = np.where(better, best, here)
            members[rows] = members_of(labels[rows], n_labels)
        if (labels == before).all():
            break
    return labels
