"""What psi (eq. 5) says: a word, which numbers of parts are good, if more may be."""

from __future__ import annotations

import math
from collections.abc import Mapping

# Words for the quality of parts, each with the least share of the largest possible psi.
# The defaults reach 0.79 to 0.96 on the models of the Princeton benchmark.
_WORDS = ((0.85, "Very Good"), (0.75, "Good"), (0.6, "Fair"), (0.0, "Poor"))

# A coarse number of parts has at least this share of the largest gain in psi, and a
# fine one is at most so many times the best number.
_COARSE, _FINE = 0.8, 2

# Psi still rises if, by part, the last few parts gain more than this share of what all
# gain. On the benchmark it is 0.17 at most, on gears and spiky balls 0.38 or more.
_LAST_FEW, _RISING = 3, 0.25


def quality_word(psi: float, psi_before: float, alpha: float) -> str:
    """Return a word for the quality of parts, "Very Good" to "Poor".

    Psi is largest if no two samples that see each other are in different parts, and all
    that are hidden from each other are. The word says how much of that is reached.

    Parameters
    ----------
    psi : float
        Of the parts.
    psi_before : float
        Of the whole shape as one part: the share of visible pairs.
    alpha : float
        The weight of hidden pairs in psi.

    Returns
    -------
    word : str
    """
    largest = psi_before + alpha * (1.0 - psi_before)
    share = psi / largest if largest > 0 else 1.0
    return next((word for least, word in _WORDS if share >= least), _WORDS[-1][1])


def good_numbers(psi_by_k: Mapping[int, float], best_k: int) -> tuple[int, ...]:
    """Return up to three good numbers of parts: a coarse, the best and a fine one.

    The coarse one is the smallest that has four fifths of the largest gain in psi over
    one part. The fine one gains most of all numbers from the best to twice that.

    Parameters
    ----------
    psi_by_k : mapping of int to float
        Psi for every number of parts k that was tried.
    best_k : int
        The number that the search chooses; 1 is good alone.

    Returns
    -------
    numbers : tuple of int
        Different numbers, the smallest first.
    """
    if best_k not in psi_by_k or best_k == 1:
        return (best_k,)
    low, high = psi_by_k.get(1, min(psi_by_k.values())), max(psi_by_k.values())
    enough = low + _COARSE * (high - low)
    coarse = min(k for k, psi in psi_by_k.items() if psi >= enough)
    finer = sorted(k for k in psi_by_k if best_k <= k <= _FINE * best_k)
    fine = max(finer, key=psi_by_k.__getitem__)
    return tuple(sorted({min(coarse, best_k), best_k, fine}))


def still_rises(psi_by_k: Mapping[int, float], best_k: int, last: int) -> bool:
    """Return whether there may be more parts than so many, which were tried last.

    Parameters
    ----------
    psi_by_k : mapping of int to float
        Psi for every number of parts k that was tried, and for one part.
    best_k : int
        The best of these numbers.
    last : int
        If so many parts could not be made, no more can.

    Returns
    -------
    bool
    """
    if best_k == last:
        return True
    if last not in psi_by_k:
        return False
    few = psi_by_k[last] - psi_by_k.get(last - _LAST_FEW, math.inf)
    of_all = abs(psi_by_k[last] - psi_by_k[1])
    return few / _LAST_FEW > _RISING * of_all / (last - 1)
