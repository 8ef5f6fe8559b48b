"""The search for the number of parts k by psi (section 5 of the paper)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..steps.progress import Progress, Steps, within
from .partition import Candidate, Partitioner, count
from .seams import seamed

# The last hundredths of all there is to gain are no reason for one more part, as the
# sampling error of psi is none: psi saturates.
_GAIN_TOLERANCE = 0.035


class Search(NamedTuple):
    """What came of trying several numbers of parts k.

    Attributes
    ----------
    parts : (P,) int
        The parts asked for, with their seams cut.
    psi_by_k : dict of int to float
        For one part, and for every k that was tried and that the shape allows; before
        seams are cut.
    best_k : int
        The k that a search chooses.
    """

    parts: NDArray[np.int64]
    psi_by_k: dict[int, float]
    best_k: int


def search_part_count(partitioner: Partitioner, low: int, high: int) -> Steps[Search]:
    """Return the parts of nearly the largest psi, over every k from `low` to `high`.

    Of several k that gain as much over one part, but for a small share of it and the
    sampling error of psi, the smallest whose parts are as good as k-means' clusters;
    one part where no more of them gain anything. Parts are connected and clusters need
    not be: where these are better, they lie in pieces that want to be parts. Up to
    twice as many are taken where these leave no part without its mirror image.
    """
    tried = yield from within(_tried(partitioner, low, high), 0.0, 0.7)
    psi_by_k = {k: candidate.psi for k, candidate in tried.items()}
    most = max(psi_by_k.values())
    noise = 2 * partitioner.negligible
    enough = most - max(noise, _GAIN_TOLERANCE * (most - psi_by_k[1]))
    good = sorted(k for k, psi in psi_by_k.items() if psi >= enough)
    n_parts = yield from within(_first_like(partitioner, tried, good), 0.7, 0.9)
    # Parts that lack their image on the other side are too few: at most by half.
    even = [k for k in good if tried[k].even and n_parts < k <= 2 * n_parts]
    if n_parts and not tried[n_parts].even:
        steps = _first_like(partitioner, tried, even)
        n_parts = (yield from within(steps, 0.9, 1.0)) or n_parts
    n_parts = n_parts or good[0]
    parts = yield from seamed(partitioner, tried[n_parts].parts)
    return Search(parts, psi_by_k, n_parts)


def _first_like(
    partitioner: Partitioner, tried: dict[int, Candidate], numbers: Sequence[int]
) -> Steps[int]:
    """Return the first k whose parts are as good as k-means' clusters, 0 if none is."""
    for number, k in enumerate(numbers):
        # Seldom more than one: each reports half of the progress that is left.
        begin, end = (1.0 - 0.5**n for n in (number, number + 1))
        steps = seamed(partitioner, tried[k].parts)
        parts = yield from within(steps, begin, end)
        if not partitioner.by_psi:
            return k
        shortfall = partitioner.psi_of_clusters(k) - partitioner.psi(parts)
        if shortfall <= partitioner.negligible:
            return k
    return 0


def given_part_count(
    partitioner: Partitioner, n_parts: int, low: int, high: int
) -> Steps[Search]:
    """Return the parts that a search from `low` to `high` would find for `n_parts`.

    As many as can be where these are fewer. The search is made, too: it tells what
    other numbers would give.
    """
    searched = yield from within(search_part_count(partitioner, low, high), 0.0, 0.6)
    fewest = min(n_parts, low)
    tried = yield from within(_tried(partitioner, fewest, high), 0.6, 0.7)
    if n_parts > high:
        tried = yield from within(_with_more(partitioner, tried, n_parts), 0.7, 0.8)
    made = min(n_parts, max(tried))
    parts = yield from within(seamed(partitioner, tried[made].parts), 0.8, 1.0)
    psi_by_k = dict(sorted(({made: tried[made].psi} | searched.psi_by_k).items()))
    return Search(parts, psi_by_k, searched.best_k)


def _tried(
    partitioner: Partitioner, low: int, high: int
) -> Steps[dict[int, Candidate]]:
    """Return the candidates for one part, and for every k that the shape allows."""
    make = partial(_try, partitioner, low, high)
    return (yield from partitioner.of_searches.recall_steps((low, high), make))


def _try(partitioner: Partitioner, low: int, high: int) -> Steps[dict[int, Candidate]]:
    """Find the candidates for one part, and for every k that the shape allows."""
    tried = {1: partitioner.candidate(1)}
    for n_parts in range(low, high + 1):
        begin, end = ((n - low) / (high + 1 - low) for n in (n_parts, n_parts + 1))
        steps = _candidate(partitioner, n_parts)
        candidate = yield from within(steps, 0.8 * begin, 0.8 * end)
        tried.setdefault(count(candidate.parts), candidate)
        if count(candidate.parts) < n_parts:
            break
    most = max(tried)
    for n_parts in range(most - 1, low - 1, -1):
        done = (most - n_parts) / (most + 1 - low)
        yield Progress("Number of parts", 0.8 + 0.1 * done)
        tried[n_parts] = partitioner.better(n_parts, most)
    return (yield from within(_evened(partitioner, tried), 0.9, 1.0))


def _with_more(
    partitioner: Partitioner, tried: dict[int, Candidate], n_parts: int
) -> Steps[dict[int, Candidate]]:
    """Return candidates, with one for more parts than those that were searched."""
    candidate = yield from within(_candidate(partitioner, n_parts), 0.0, 0.8)
    more = {count(candidate.parts): candidate} | tried
    return (yield from within(_evened(partitioner, more), 0.8, 1.0))


def _candidate(partitioner: Partitioner, n_parts: int) -> Steps[Candidate]:
    """Return the partitioner's candidate, in two steps."""
    yield Progress("Number of parts", 0.0)
    partitioner.plain(n_parts)  # remembered: half of the work
    yield Progress("Number of parts", 0.5)
    return partitioner.candidate(n_parts)


def _evened(
    partitioner: Partitioner, tried: dict[int, Candidate]
) -> Steps[dict[int, Candidate]]:
    """Return symmetric candidates in the place of others that are hardly better."""
    if not partitioner.by_psi:
        return tried
    found: dict[int, Candidate] = {}
    uneven = [candidate for candidate in tried.values() if not candidate.even]
    for number, candidate in enumerate(uneven):
        steps = partitioner.symmetric(candidate.parts, tried)
        begin, end = number / len(uneven), (number + 1) / len(uneven)
        for even in (yield from within(steps, begin, end)):
            n_parts = count(even.parts)
            rival = found.get(n_parts, tried[n_parts])
            slack = 0.0 if rival.even else 2 * partitioner.negligible
            if even.psi >= rival.psi - slack:
                found[n_parts] = even
    return tried | found
