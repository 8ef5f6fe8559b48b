"""Finds about the parts that a search finds, in a tenth of a second.

While settings change in a window, these are shown until the parts themselves are found.
"""

from __future__ import annotations

import numpy as np

from ..steps.memo import Memo
from ..steps.progress import Steps, run, within
from .part_count import PartCountSearch, Search
from .part_memo import Candidate
from .part_psi import count_parts
from .seams.cutter import SeamCutter, Seams

# How many more clusters than parts to split by, in turn: with two more, one k-means is
# mostly enough.
_TRIES = (2, 8)
# One sweep of the cut brings seams near their places.
_SWEEPS = 1


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
    known = _known(search, n_parts)
    return known is not None and search.seams.knows(known.parts)


def likely_number(search: PartCountSearch, tried: dict[int, Candidate]) -> int:
    """Return about the number of parts that is best, 0 if nothing was tried.

    Parameters
    ----------
    search : PartCountSearch
    tried : dict of int to Candidate
        Candidates that were found with other parameters, by number of parts.
    """
    if not tried:
        return 0
    return min(max(search.rated(tried)[1], search.low), search.high)


def _known(search: PartCountSearch, n_parts: int) -> Candidate | None:
    """Return the candidate for a number, or for the highest below it that was made."""
    tried = run(search.tried()) if search.searched else {}
    return tried.get(min(n_parts, max(tried, default=0)))


def guess(
    search: PartCountSearch, n_parts: int, memo: Memo[tuple[float, bytes], Seams]
) -> Steps[Search]:
    """Return about the parts that the search gives for a number of parts.

    Parameters
    ----------
    search : PartCountSearch
        Nothing is searched for. Numbers it has tried are known.
    n_parts : int
    memo : Memo
        Maps a smoothness and the digest of parts to the parts with their seams cut.

    Returns
    -------
    Steps of Search
        It has the psi of no other number, and 0 as `best_k`.
    """
    by, enough, known = search.partitioner, None, _known(search, n_parts)
    if known is None:
        parts = (yield from within(search.alone(n_parts), 0.0, 0.6)).parts
    elif n_parts > search.high:
        steps = by.resized_in_steps(known.parts, n_parts, _TRIES)
        parts = yield from within(steps, 0.0, 0.6)
        enough = -np.inf  # what k-means alone would find takes long to know
    else:
        parts = known.parts
    cutter = SeamCutter(by, memo, _SWEEPS)
    seams = yield from within(cutter.cut(parts, enough), 0.6, 1.0)
    return Search(seams, {count_parts(parts): by.psi_seen(parts)}, 0)
