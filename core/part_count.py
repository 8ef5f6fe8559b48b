"""The search for the number of parts k by psi (section 5 of the paper)."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from .partition import Partitioner, count
from .progress import Progress, Steps, within

# Psi of two sets of samples of one shape differs by about this much, over the square
# root of their number: a gain below it is no reason for one more part, ...
_PSI_TOLERANCE = 0.2
# ... nor are the last hundredths of all there is to gain: psi saturates.
_GAIN_TOLERANCE = 0.035


Partitions: TypeAlias = tuple[NDArray[np.int64], dict[int, float]]


def search_part_count(
    partitioner: Partitioner, low: int, high: int
) -> Steps[Partitions]:
    """Return the parts of nearly the largest psi, over every k from `low` to `high`.

    Of several k that gain as much over one part, but for a small share of it and the
    sampling error of psi, the smallest; one part where no more of them gain anything.

    Returns
    -------
    parts : (P,) int
    psi_by_k : dict of int to float
        For one part, and for every k that the shape allows.
    """
    parts_by_k, psi_by_k = yield from _tried(partitioner, low, high)
    best = best_part_count(psi_by_k, len(partitioner.visibility.samples))
    return parts_by_k[best], psi_by_k


def best_part_count(psi_by_k: dict[int, float], n_samples: int) -> int:
    """Return the smallest k whose psi is as good as the largest of those tried."""
    most = max(psi_by_k.values())
    noise = _PSI_TOLERANCE / np.sqrt(n_samples)
    enough = most - max(noise, _GAIN_TOLERANCE * (most - psi_by_k[1]))
    return min(k for k, psi in psi_by_k.items() if psi >= enough)


def given_part_count(
    partitioner: Partitioner, n_parts: int, low: int, high: int
) -> Steps[Partitions]:
    """Return the parts that a search from `low` to `high` would find for `n_parts`.

    As many as can be where these are fewer; otherwise like `search_part_count`.
    """
    most = max(n_parts, high) if partitioner.by_psi else n_parts
    tried = _tried(partitioner, n_parts, most)
    parts_by_k, psi_by_k = yield from within(tried, 0.0, 0.8)
    most = max(parts_by_k)
    parts = parts_by_k[min(n_parts, most)]
    # Fewer than asked for are of interest, too, where a search would try them.
    top = most if most <= high else high
    for fewer in range(min(n_parts - 1, top), low - 1, -1):
        yield Progress("Number of parts", 0.8)
        partitioner.plain(fewer)
        yield Progress("Number of parts", 0.8)
        found = partitioner.better(fewer, top)
        psi_by_k.setdefault(count(found.parts), found.psi)
    return parts, dict(sorted(psi_by_k.items()))


def _tried(
    partitioner: Partitioner, low: int, high: int
) -> Steps[tuple[dict[int, NDArray[np.int64]], dict[int, float]]]:
    """Return the parts and psi of one part, and of every k that the shape allows."""
    tried = {1: partitioner.candidate(1)}
    for n_parts in range(low, high + 1):
        done = (n_parts - low) / (high + 1 - low)
        yield Progress("Number of parts", 0.8 * done)
        partitioner.plain(n_parts)  # remembered: half of the work, a step of its own
        yield Progress("Number of parts", 0.8 * done)
        candidate = partitioner.candidate(n_parts)
        tried.setdefault(count(candidate.parts), candidate)
        if count(candidate.parts) < n_parts:
            break
    most = max(tried)
    for n_parts in range(most - 1, low - 1, -1):
        done = (most - n_parts) / (most + 1 - low)
        yield Progress("Number of parts", 0.8 + 0.2 * done)
        tried[n_parts] = partitioner.better(n_parts, most)
    return (
        {k: candidate.parts for k, candidate in tried.items()},
        {k: candidate.psi for k, candidate in tried.items()},
    )
