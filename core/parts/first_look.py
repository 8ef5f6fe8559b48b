"""Finds parts much like those of a search, in a tenth of a second.

While settings change in a window, these are shown until the parts themselves are found.
"""

from __future__ import annotations

from ..steps.progress import Steps, within
from .part_count import PartCountSearch, Search
from .part_count_given import least_psi, own_parts
from .part_psi import count_parts
from .seams.cutter import SeamCutter

# One sweep of the cut brings seams near their places.
_SWEEPS = 1


def likely_number(search: PartCountSearch) -> int:
    """Return roughly the best number of parts, 0 if nothing was tried.

    It is that of the latest search, which may have had other parameters.
    """
    tried = search.partitioner.memo.tried
    if not tried:
        return 0
    return min(max(search.rated(tried)[1], search.low), search.most)


def guess(search: PartCountSearch, n_parts: int) -> Steps[Search]:
    """Return parts much like those that the search gives for a number of parts.

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
    high = search.first_high
    if search.searched:
        high, _ = yield from search.tried()
        parts = yield from within(own_parts(search, n_parts), 0.0, 0.6)
    else:
        parts = (yield from within(search.alone(n_parts), 0.0, 0.6)).parts
    cutter = SeamCutter(search.partitioner, _SWEEPS, rough=True)
    seams = yield from within(cutter.cut(parts, least_psi(n_parts, high)), 0.6, 1.0)
    psi_by_k = {count_parts(parts): search.partitioner.psi_seen(parts)}
    return Search(seams, psi_by_k, 0)
