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
    sampling error of psi, the smallest whose parts are as good as k-means' clusters;
    one part where no more of them gain anything. Parts are connected and clusters need
    not be: where these are better, they lie in pieces that want to be parts.

    Returns
    -------
    parts : (P,) int
        With their seams cut.
    psi_by_k : dict of int to float
        For one part, and for every k that the shape allows; before seams are cut.
    """
    tried = _partitions(partitioner, low, high)
    parts_by_k, psi_by_k = yield from within(tried, 0.0, 0.7)
    most = max(psi_by_k.values())
    noise = _PSI_TOLERANCE / np.sqrt(len(partitioner.visibility.samples))
    enough = most - max(noise, _GAIN_TOLERANCE * (most - psi_by_k[1]))
    good = sorted(k for k, psi in psi_by_k.items() if psi >= enough)
    for number, k in enumerate(good):
        # Seldom more than one: each reports half of the progress that is left.
        begin, end = (1.0 - 0.3 * 0.5**n for n in (number, number + 1))
        seamed = partitioner.seamed(parts_by_k[k])
        parts = yield from within(seamed, begin, end)
        if k == good[0]:
            fewest = parts
        shortfall = partitioner.psi_of_clusters(k) - partitioner.psi(parts)
        if not partitioner.by_psi or shortfall <= noise / 2:
            return parts, psi_by_k
    return fewest, psi_by_k


def given_part_count(
    partitioner: Partitioner, n_parts: int, high: int
) -> Steps[Partitions]:
    """Return the parts that a search up to `high` would find for k = `n_parts`.

    As many as can be where these are fewer; otherwise like `search_part_count`.
    """
    if not partitioner.by_psi:
        high = n_parts
    tried = _partitions(partitioner, n_parts, max(n_parts, high))
    parts_by_k, psi_by_k = yield from within(tried, 0.0, 0.7)
    parts = parts_by_k[min(n_parts, max(parts_by_k))]
    return (yield from within(partitioner.seamed(parts), 0.7, 1.0)), psi_by_k


def _partitions(
    partitioner: Partitioner, low: int, high: int
) -> Steps[tuple[dict[int, NDArray[np.int64]], dict[int, float]]]:
    """Return the parts and psi of one part, and of every k that the shape allows."""
    parts_by_k = {1: partitioner.partition(1)}
    for n_parts in range(low, high + 1):
        yield Progress("Number of parts", 0.8 * (n_parts - low) / (high + 1 - low))
        parts = partitioner.partition(n_parts)
        parts_by_k.setdefault(count(parts), parts)
        if count(parts) < n_parts:
            break
    psi_by_k = {k: partitioner.psi(parts) for k, parts in parts_by_k.items()}
    if partitioner.by_psi:
        # What k-means misses with few clusters it may find with more.
        most = max(parts_by_k)
        for n_parts in range(most - 1, low - 1, -1):
            done = (most - n_parts) / (most + 1 - low)
            yield Progress("Number of parts", 0.8 + 0.2 * done)
            merged = partitioner.merged(parts_by_k[n_parts + 1], n_parts)
            psi = partitioner.psi(merged)
            if psi > psi_by_k[n_parts]:
                parts_by_k[n_parts], psi_by_k[n_parts] = merged, psi
    return parts_by_k, psi_by_k
