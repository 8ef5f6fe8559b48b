"""Searches for the number of parts k by psi (section 5 of the paper)."""

from __future__ import annotations

from functools import partial
from math import ceil, log2
from typing import NamedTuple

from ..parameters.parts import Parameters
from ..results.psi import still_rises
from ..steps.memo import computed_once
from ..steps.progress import Progress, Steps, within, within_turn
from .merging.creases import CreaseParts
from .part_memo import Candidate
from .part_psi import count_parts
from .partition import Partitioner
from .seams.cutter import SeamCutter, Seams

# Psi grows more and more slowly with k. A k is good enough if its psi is below the
# largest psi by at most this share of the largest gain over one part.
_GAIN_TOLERANCE = 0.025
# Symmetric parts may lack this share. So may parts that were found from lines of sight
# alone: they fit the chance in the very pairs that psi is counted from.
_WIDE_TOLERANCE = 0.035
# One of many equal parts gains little. At most this share of its gain may be lacking.
_OF_ONE_PART = 0.5
# Above this number only every second one gets parts of its own. For those between,
# parts of one more are merged: errors on the benchmark are the same.
_ALL_OWN = 5
# Symmetric parts are preferred up to this number, times k.
_MORE = 1.5
# Last number that is tried at first. It is doubled while psi still rises.
_FIRST_HIGH = 13


class Search(NamedTuple):
    """The result of a search for the number of parts k.

    Attributes
    ----------
    seams : Seams
        The chosen parts, with their seams cut.
    psi_by_k : dict of int to float
        Psi of one part, and of each k tried for which k parts were found, before seams
        are cut, counted from lines of sight alone.
    best_k : int
        The number of parts that the search chooses.
    """

    seams: Seams
    psi_by_k: dict[int, float]
    best_k: int


class PartCountSearch:
    """Tries numbers of parts and chooses one by psi.

    Parameters
    ----------
    partitioner : Partitioner
        Finds the parts for each number. Its parameters tell which are tried.

    Attributes
    ----------
    partitioner : Partitioner
        As given.
    found : FoundMemo
        What is found with its parameters.
    seams : SeamCutter
    creases : CreaseParts
        Parts along creases, which compete with others.
    low, most : int
        Least and largest number of parts.
    first_high : int
        Last number that is tried at first.
    """

    def __init__(self, partitioner: Partitioner) -> None:
        self.partitioner, self.found = partitioner, partitioner.found
        self.seams = SeamCutter(partitioner)
        self.creases = CreaseParts(partitioner)
        self.low = partitioner.parameters.min_parts
        self.most = partitioner.parameters.max_parts
        doublings = max(0, ceil(log2(self.low / _FIRST_HIGH)))
        self.first_high = min(_FIRST_HIGH * 2**doublings, self.most)

    def best(self) -> Steps[Search]:
        """Return the parts for the smallest k that is good enough.

        1. A k is good enough if its psi is nearly the largest of all k. Here psi is
           counted from lines of sight alone: likely pairs find better parts, but tell
           less well how many there are.
        2. If the parts of a symmetric shape are not symmetric for the smallest such k,
           prefer the first with symmetric parts, up to 1.5k. Its psi may be a little
           lower.
        3. If psi still rises at the last number that was tried, try more, up to `most`.
        4. Cut along closed loops of creases, too, or only there, if what that saves in
           seams outweighs what is lost in psi. Or leave the shape whole, if that is
           better than any of these. Merge parts whose seam gains next to nothing.
           Fewest Parts sets a limit to both.

        Returns
        -------
        Steps of Search
        """
        _, tried = yield from within(self.tried(), 0.0, 0.9)
        psi_by_k, best_k = self.rated(tried)
        seams = yield from within(self.seams.cut(tried[best_k].parts), 0.9, 1.0)
        low = self.low if self.low > Parameters.min_parts else 1
        yield from within(self.creases.graph_in_steps(), 1.0, 1.0)
        parts = self.creases.better(seams.parts, low, self.most)
        if parts is not seams.parts:
            seams, best_k = Seams(parts), count_parts(parts)
            psi_by_k |= {best_k: self.partitioner.psi_seen(parts)}
        return Search(seams, dict(sorted(psi_by_k.items())), best_k)

    @property
    def searched(self) -> bool:
        """Whether all numbers to try were tried before: `tried` takes no time."""
        high, more = 0, self.first_high
        while high < more and (self.low, more) in self.found.searches:
            high = more
            more = self._next(high, self.found.searches[self.low, high])
        return high == more

    @computed_once
    def tried(self) -> Steps[tuple[int, dict[int, Candidate]]]:
        """Try numbers of parts, and more of them while psi still rises at the last.

        Returns
        -------
        high : int
            Last number that was tried.
        tried : dict of int to Candidate
            For one part, and for each number that can be made.
        """
        high, share = self.first_high, 0.0
        while True:
            steps = self.between(self.low, high)
            tried = yield from within(steps, share, 1.0)
            more = self._next(high, tried)
            if more == high:
                return high, tried
            high, share = more, 1.0  # more are seldom tried, and in little time

    def _next(self, high: int, tried: dict[int, Candidate]) -> int:
        """Return the last number to go on to: doubled if psi still rises at `high`."""
        rises = still_rises(*self.rated(tried), high)
        return min(2 * high, self.most) if rises else high

    def between(self, low: int, high: int) -> Steps[dict[int, Candidate]]:
        """Return candidates for 1 and `low`…`high` parts, of each that can be made."""
        steps = partial(self._try, low, high)
        return self.found.searches.recall_steps((low, high), steps)

    def alone(self, n_parts: int) -> Steps[Candidate]:
        """Return the candidate for a number of parts, found without the others."""
        # Half of the work; the memo keeps it.
        yield from within(self.partitioner.plain_in_steps(n_parts), 0.0, 0.5)
        yield Progress("Number of parts", 0.5)
        return self.partitioner.candidate(n_parts)

    def rated(self, tried: dict[int, Candidate]) -> tuple[dict[int, float], int]:
        """Return psi by lines of sight of each candidate, and the best number of parts.

        Parameters
        ----------
        tried : dict of int to Candidate
            They may have been found with other parameters.
        """
        psi_seen = self.partitioner.psi_seen
        psi_by_k = {k: psi_seen(candidate.parts) for k, candidate in tried.items()}
        guessed = self.partitioner.visibility.is_guessed
        narrow = _GAIN_TOLERANCE if guessed else _WIDE_TOLERANCE
        best_k = self._good_enough(psi_by_k, narrow)[0]
        if tried[best_k].even:
            return psi_by_k, best_k
        wide = self._good_enough(psi_by_k, _WIDE_TOLERANCE)
        even = (k for k in wide if tried[k].even and k <= _MORE * best_k)
        return psi_by_k, min(even, default=best_k)

    def _good_enough(self, psi_by_k: dict[int, float], tolerance: float) -> list[int]:
        """Return each k whose gain lacks at most a share, or the sampling error."""
        best = max(psi_by_k, key=psi_by_k.__getitem__)
        most, partitioner = psi_by_k[best], self.partitioner
        strictness = _strictness(partitioner.parameters.alpha)
        share = min(tolerance, _OF_ONE_PART / best) * strictness
        enough = most - max(partitioner.sampling_error, share * (most - psi_by_k[1]))
        return sorted(k for k, psi in psi_by_k.items() if psi >= enough)

    def _try(self, low: int, high: int) -> Steps[dict[int, Candidate]]:
        """Find what `between` returns."""
        top = yield from within(self.alone(high), 0.0, 0.2)
        most = count_parts(top.parts)
        tried = {1: self.partitioner.candidate(1), most: top}
        fewer = range(most - 1, max(low, 2) - 1, -1)
        for turn, n_parts in enumerate(fewer):
            steps = self._with_fewer(tried[n_parts + 1], n_parts, most)
            within_this = within_turn(steps, turn, len(fewer))
            tried[n_parts] = yield from within(within_this, 0.2, 0.9)
        return (yield from within(self._evened(tried), 0.9, 1.0))

    def _with_fewer(self, more: Candidate, n_parts: int, most: int) -> Steps[Candidate]:
        """Return the candidate for a number of parts, or merged parts if better.

        With more clusters, k-means may find a part that it misses with fewer.

        Parameters
        ----------
        more : Candidate
            For one part more.
        n_parts : int
        most : int
            Largest number of parts that was made.
        """
        partitioner = self.partitioner
        parts = partitioner.merged(more.parts, n_parts)
        merged = Candidate(parts, partitioner.psi(parts))
        if partitioner.by_psi and n_parts > _ALL_OWN and (most - n_parts) % 2:
            return merged
        own = yield from self.alone(n_parts)
        is_short = count_parts(own.parts) < n_parts
        is_worse = partitioner.by_psi and own.psi < merged.psi
        return merged if is_short or is_worse else own

    def _evened(self, tried: dict[int, Candidate]) -> Steps[dict[int, Candidate]]:
        """Replace candidates by symmetric ones whose psi is not clearly lower."""
        partitioner = self.partitioner
        if not partitioner.by_psi:
            return tried
        found: dict[int, Candidate] = {}
        uneven = [candidate for candidate in tried.values() if not candidate.even]
        for number, candidate in enumerate(uneven):
            steps = partitioner.symmetric(candidate.parts, tried)
            for even in (yield from within_turn(steps, number, len(uneven))):
                n_parts = count_parts(even.parts)
                rival = found.get(n_parts, tried[n_parts])
                slack = 0.0 if rival.even else partitioner.sampling_error
                if even.psi >= rival.psi - slack:
                    found[n_parts] = even
        return tried | found


def _strictness(alpha: float) -> float:
    """Return the factor of all tolerances: 1 up to the default alpha, then less.

    A larger alpha scales all gains alike, so that alone it would hardly change k.
    """
    return Parameters.alpha / max(alpha, Parameters.alpha)
