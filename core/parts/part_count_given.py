"""Finds a number of parts that the user gives."""

from __future__ import annotations

import numpy as np

from ..clusters.embedding import coordinates_for
from ..steps.arrays import IntArray
from ..steps.progress import Steps, within
from .part_count import PartCountSearch, Search
from .part_psi import count_parts
from .partition import Partitioner
from .seams.cutter import Seams

# How many more clusters than parts many are split by, in turn. With two more, one
# k-means is mostly enough.
_FEW_TRIES = (2, 8)


def given(search: PartCountSearch, n_parts: int) -> Steps[Search]:
    """Return a number of parts, with the psi of other numbers for comparison.

    These are the parts that the search chooses, if they are so many. Otherwise those
    compete too, split or merged. The largest psi wins, less what seams cost.

    Parameters
    ----------
    search : PartCountSearch
    n_parts : int
        There are fewer parts if the shape cannot be split into so many.

    Returns
    -------
    Steps of Search
        `best_k` is the k that the search chooses.
    """
    return search.found.given.recall_steps(
        _key(search, n_parts), lambda: _find(search, n_parts)
    )


def knows(search: PartCountSearch, n_parts: int) -> bool:
    """Return whether the result of `given` is known already."""
    return _key(search, n_parts) in search.found.given


def _key(search: PartCountSearch, n_parts: int) -> tuple[int, int, int, float]:
    """Return the key under which the result of `given` is kept."""
    smoothness = search.partitioner.parameters.smoothness
    return n_parts, search.low, search.most, smoothness


def _find(search: PartCountSearch, n_parts: int) -> Steps[Search]:
    """Return what `given` does."""
    searched = yield from within(search.best(), 0.0, 0.6)
    chosen, partitioner = searched.seams.parts, search.partitioner
    if count_parts(chosen) == n_parts:
        return searched
    high, _ = yield from search.tried()
    own = yield from within(own_parts(search, n_parts), 0.6, 0.7)
    made, many = count_parts(own), n_parts > high
    resized = yield from within(_resized(partitioner, chosen, made, high), 0.7, 0.8)
    if many:  # to cut the seams of both takes long
        rivals = own, resized
        own = max(rivals, key=lambda each: (count_parts(each), partitioner.psi(each)))
    least = least_psi(n_parts, high)
    found = [(yield from within(search.seams.cut(own, least), 0.8, 0.9))]
    if not many:
        smooth = yield from within(search.seams.cut(resized), 0.9, 1.0)
        found += [Seams(resized), smooth]
    psi_by_k = {made: partitioner.psi_seen(own)} | searched.psi_by_k
    own_seams, *labels = (each.parts for each in found)
    best = search.creases.better(own_seams, made, made, *labels)
    if best is not own_seams:
        psi_by_k |= {made: partitioner.psi_seen(best)}
    # Parts that follow creases are none of those found.
    seams = next((each for each in found if each.parts is best), Seams(best))
    return Search(seams, dict(sorted(psi_by_k.items())), searched.best_k)


def own_parts(search: PartCountSearch, n_parts: int) -> Steps[IntArray]:
    """Return parts (P,) that are found for a number, before their seams are cut.

    More parts than the search tries are the most that it tries, split further. They
    have a larger psi than what k-means finds for so many, and take less time.
    """
    partitioner, (high, tried) = search.partitioner, (yield from search.tried())
    if n_parts < search.low:
        tried = yield from search.between(n_parts, high)
    if n_parts <= high:
        return tried[min(n_parts, max(tried))].parts
    if not partitioner.by_psi:
        return (yield from search.alone(n_parts)).parts
    return (yield from _resized(partitioner, tried[max(tried)].parts, n_parts, high))


def _resized(
    partitioner: Partitioner, parts: IntArray, n_parts: int, high: int
) -> Steps[IntArray]:
    """Return parts (P,) split or merged so that there are `n_parts`.

    More than `high` are as many as the embedding serves, merged. So the same clusters
    serve all such numbers, and one part more divides one part.
    """
    if n_parts <= high:
        return partitioner.resized_in_steps(parts, n_parts)
    most = coordinates_for(n_parts)
    return partitioner.resized_in_steps(parts, n_parts, most, _FEW_TRIES)


def least_psi(n_parts: int, high: int) -> float | None:
    """Return the least psi that `own_parts` may have once their seams are cut.

    None stands for the psi of the parts that k-means alone finds. More parts than
    `high` have no limit: to find those of k-means would take long.
    """
    return None if n_parts <= high else -np.inf
