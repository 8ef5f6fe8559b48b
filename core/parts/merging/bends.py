"""Finds parts of which none ends at a mere bend, for the parameter Bends."""

from __future__ import annotations

from ...steps.progress import Steps, within, within_turn
from ..part_count import PartCountSearch, Search
from ..part_count_given import given
from ..part_psi import count_parts
from .limbs import LimbMerger


def with_bends_kept(search: PartCountSearch) -> Steps[Search]:
    """Search for parts of which none ends at a mere bend.

    Parameters
    ----------
    search : PartCountSearch
        If its parameters give a number of parts, more are found first, so that as many
        are left. If no number that the search tries leaves as many, bends are cut.

    Returns
    -------
    Steps of Search
        `best_k` is the number of parts that are left of those that the search chooses.
    """
    merger, parameters = LimbMerger(search.partitioner), search.partitioner.parameters
    n_parts = parameters.parts
    found = yield from within(search.best(), 0.0, 0.5)
    merged = yield from merger.merge(found.seams.parts)
    best_k = left = count_parts(merged)
    high, _ = yield from search.tried()
    numbers = range(n_parts, high + 1) if n_parts else ()
    for turn, k in enumerate(numbers):
        if left == n_parts or (turn and left > n_parts):
            break
        steps = within_turn(given(search, k), turn, len(numbers))
        found = yield from within(steps, 0.5, 0.9)
        merged = yield from merger.merge(found.seams.parts)
        left = count_parts(merged)
    if n_parts and left != n_parts:
        found = yield from within(given(search, n_parts), 0.9, 1.0)
        merged = found.seams.parts
    return Search(found.seams._replace(parts=merged), found.psi_by_k, best_k)
