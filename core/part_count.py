"""The search for the number of parts k by psi (section 5 of the paper)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .partition import Partitioner, count
from .progress import Progress, Steps


def search_part_count(
    partitioner: Partitioner, low: int, high: int
) -> Steps[tuple[NDArray[np.int64], dict[int, float]]]:
    """Return the parts of largest psi, over every k from `low` to `high`.

    One part stays when no more of them gains anything.

    Returns
    -------
    parts : (P,) int
    psi_by_k : dict of int to float
        For one part, and for every k that the shape allows.
    """
    best = partitioner.partition(1)
    highest = partitioner.psi(best)
    psi_by_k = {1: highest}
    for n_parts in range(low, high + 1):
        yield Progress("Number of parts", (n_parts - low) / (high + 1 - low))
        parts = partitioner.partition(n_parts)
        if count(parts) < n_parts:
            break
        psi_by_k[n_parts] = partitioner.psi(parts)
        if psi_by_k[n_parts] > highest:
            best, highest = parts, psi_by_k[n_parts]
    return best, psi_by_k
