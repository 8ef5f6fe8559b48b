"""How likely two samples lie in one part, from what both of them see.

A single line of sight says little about two samples: around the bend of an arm it is
hidden, and through a thick neck it is visible. Samples of one part also see much the
same, and are near each other. This module goes beyond the paper.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.distance import cdist
from scipy.special import expit

from ..steps.arrays import FloatArray
from ..steps.one_thread import on_one_thread
from ..steps.progress import Progress, Steps
from ..steps.rows import blocks
from .pair_visibility import PairVisibility

# Share of the line of sight itself. Without it, corners of an L or a U became parts.
_SIGHT = 0.3
# Logarithms of the odds that two samples lie in one part, by logistic regression on
# what people did with the models of the Princeton Segmentation Benchmark. Two halves
# of these models gave nearly the same numbers.
_START = -3.5
# They see each other.
_VISIBLE = 0.7
# Samples that both see, as a share of those that either sees.
_COMMON = 7.1
# Their distance, in root mean squares of all distances.
_DISTANCE = -1.4
# The logarithm of the share of all samples that each of them sees, and a little: those
# that see most of a shape have much in common with all.
_REACH, _LITTLE = -0.55, 0.03
# Probabilities are multiples of this: float32 sums are then exact in any order.
_UNIT = 1 / 256
# Entries of the matrix that are computed in one step: 10 ms, or 50 with the slow matrix
# products of some systems' NumPy.
_ENTRIES_PER_STEP = 2**17


@on_one_thread
def likely_pairs(pairs: PairVisibility, positions: FloatArray) -> Steps[PairVisibility]:
    """Replace lines of sight by the probability that two samples lie in one part.

    Parameters
    ----------
    pairs : PairVisibility
        All pairs of N samples, and which of them see each other.
    positions : (N, 3) float
        Positions of the samples, in any units.

    Returns
    -------
    Steps of PairVisibility
        `visible` holds the probabilities, symmetric and 1 on the diagonal.
    """
    visible, n_samples = np.asarray(pairs.visible), pairs.n_samples
    sizes = visible.sum(axis=1)
    reach = _REACH * np.log(sizes / n_samples + _LITTLE)
    usual = np.sqrt(2 * positions.var(axis=0).sum())
    likely = np.empty_like(visible)
    for rows in blocks(n_samples, _ENTRIES_PER_STEP // n_samples):
        yield Progress("Lines of sight", rows.start / n_samples)
        rest = slice(rows.start, None)
        common = visible[rows] @ visible[:, rest]
        odds = _COMMON * common / (sizes[rows, None] + sizes[rest] - common)
        odds += _START + _VISIBLE * visible[rows, rest]
        odds += reach[rows, None] + reach[rest]
        odds += (_DISTANCE / usual) * cdist(positions[rows], positions[rest])
        mixed = _SIGHT * visible[rows, rest] + (1 - _SIGHT) * expit(odds)
        likely[rows, rest] = np.round(mixed / _UNIT) * _UNIT
        likely[rest, rows] = likely[rows, rest].T
    np.fill_diagonal(likely, 1.0)
    return PairVisibility(likely, None)
