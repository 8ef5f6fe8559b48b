"""Finds about the parts that a search finds, in a tenth of a second.

While settings change in a window, these are shown until the parts themselves are found.
"""

from __future__ import annotations

import numpy as np

from ..steps.memo import Memo
from ..steps.progress import Steps, run, within
from .part_count import PartCountSearch, Search
from .part_psi import count_parts
from .seams.cutter import SeamCutter

# How many more clusters than parts to split by, in turn: with two more, one k-means is
# mostly enough.
_TRIES = (2, 8)


def is_quick(search: PartCountSearch, n_parts: int) -> bool:
    """Return whether there is little left to do to find the parts themselves.

    Parameters
    ----------
    search : PartCountSearch
    n_parts : int
        0 for the best number.
    """
    if not search.searched or n_parts == 0:
        return search.searched
    if n_parts > search.high:
        return search.partitioner.knows(n_parts)
    tried = run(search.tried())
    return search.seams.knows(tried[min(n_parts, max(tried))].parts)


def guess(search: PartCountSearch, n_parts: int) -> Steps[Search]:
    """Return about the parts that the search gives for a number of parts.

    Parameters
    ----------
    search : PartCountSearch
        Nothing is searched for. Numbers it has tried are known.
    n_parts : int

    Returns
    -------
    Steps of Search
        It has the psi of no other number, and 0 as `best_k`.
    """
    if search.searched and n_parts > search.high:
        return _split_further(search, n_parts)
    return _candidate(search, n_parts)


def _candidate(search: PartCountSearch, n_parts: int) -> Steps[Search]:
    """Return the search's candidate for a number, without its rivals."""
    if search.searched:
        tried = yield from search.tried()
        found = tried[min(n_parts, max(tried))]
    else:
        found = yield from within(search.alone(n_parts), 0.0, 0.6)
    seams = yield from within(search.seams.cut(found.parts), 0.6, 1.0)
    psi = search.partitioner.psi_seen(found.parts)
    return Search(seams, {count_parts(found.parts): psi}, 0)


def _split_further(search: PartCountSearch, n_parts: int) -> Steps[Search]:
    """Split the parts for the highest number tried; seams may cost any psi."""
    tried, by = (yield from search.tried()), search.partitioner
    steps = by.resized_in_steps(tried[max(tried)].parts, n_parts, _TRIES)
    parts = yield from within(steps, 0.0, 0.6)
    cutter = SeamCutter(by, Memo(), 1)
    seams = yield from within(cutter.cut(parts, -np.inf), 0.6, 1.0)
    return Search(seams, {count_parts(parts): by.psi_seen(parts)}, 0)
