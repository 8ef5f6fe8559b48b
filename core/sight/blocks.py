"""Lines of sight in blocks: few of all pairs are cast, the others follow from them.

Samples that are close and face the same way see much the same. So samples are grouped,
and a random pair of every two groups is cast: the first probe of this block of the LoS
matrix. Where a block differs from its neighbors, more probes are cast. Where probes of
a block differ from each other, all of its pairs are cast. In the other blocks, all
pairs take the answer of the probes. Pairs that do not face each other need no ray, and
count nowhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..geometry.sampling import Samples
from ..steps.progress import Progress, Steps, within
from .all_pairs import facing_pairs
from .lines import RayBudget, cast_lines
from .pair_visibility import PairVisibility
from .ray_march import RayMarcher
from .sample_groups import group_samples
from .viewpoints import Viewpoints

# Probes of a block, and of a block that differs from its neighbors.
_FIRST_PROBES, _MOST_PROBES = 1, 6
# Neighbors of a block are those of the groups nearest to either of its groups.
_NEAREST = 4
# There are so many groups that first probes take at most half of so many rays a sample:
# 300 groups of 1200 samples.
_RAYS_FOR_GROUPS = 75
# Most rays a sample if the user sets no limit. Only shapes of many shells need more.
_MOST_RAYS = 200
# Entries of the matrix that are looked at in one step, about 20 ms.
_ENTRIES_PER_STEP = 2**18
# What is known of a pair of samples.
_HIDDEN, _VISIBLE, _UNKNOWN = np.arange(3, dtype=np.uint8)

Rows = TypeVar("Rows", Samples, Viewpoints)


def see_blocks(
    marcher: RayMarcher,
    samples: Samples,
    views: Viewpoints,
    n_rays: int,
    rng: np.random.Generator,
) -> Steps[PairVisibility]:
    """Compute the LoS matrix of all pairs of samples (eq. 3) from rays between some.

    Parameters
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.
    samples : Samples
        N points on its surface.
    views : Viewpoints
        Viewpoints of `samples`.
    n_rays : int
        Most rays a sample. 0 casts as many as the blocks need.
    rng : numpy.random.Generator
        Draws the pairs that are cast.

    Returns
    -------
    Steps of PairVisibility
        A dense matrix (N, N). Every sample sees itself.
    """
    per_sample = min(n_rays or _RAYS_FOR_GROUPS, _RAYS_FOR_GROUPS)
    n_groups = max(1, int(np.sqrt(per_sample * len(samples) / _FIRST_PROBES)))
    groups, nearest = group_samples(samples, marcher.diagonal, n_groups, _NEAREST)
    # Samples of a group follow each other, so that blocks are blocks of the matrix.
    order = np.argsort(groups, kind="stable")
    looking = marcher, _taken(samples, order), _taken(views, order)
    blocks = _Blocks(*looking, groups[order], nearest, rng)
    most = (n_rays or _MOST_RAYS) * len(samples)
    probing = RayBudget(most / 2)
    yield from within(blocks.cast_probes(probing), 0.0, 0.5)
    rest = RayBudget(most - probing.n_rays, probing.n_lines, probing.n_rays)
    yield from within(blocks.cast_mixed(rest), 0.5, 0.9)
    los = np.empty((len(samples), len(samples)), dtype=np.float32)
    for rows in blocks.slices():
        yield Progress("Lines of sight", 0.9)
        seen = blocks.known[rows] | blocks.known[:, rows].T
        los[np.ix_(order[rows], order)] = seen
    np.fill_diagonal(los, 1.0)
    n_inferred = int(blocks.n_facing.sum()) - rest.n_lines
    return PairVisibility(los, None, rest.n_lines, n_inferred)


class _Blocks:
    """The LoS matrix while it is filled. Samples are sorted by group.

    Attributes
    ----------
    known : (N, N) uint8
        What is known of each pair. Only entries above the diagonal are used.
    n_facing, n_cast, n_seen : (G²,) int
        Pairs of each block that face each other, those cast, and those visible of them.
    """

    def __init__(
        self,
        marcher: RayMarcher,
        samples: Samples,
        views: Viewpoints,
        groups: NDArray[np.int64],
        nearest: NDArray[np.int64],
        rng: np.random.Generator,
    ) -> None:
        self._marcher, self._samples, self._views = marcher, samples, views
        self._groups, self._nearest, self._rng = groups, nearest, rng
        self._n_groups = int(groups[-1]) + 1
        self.known = np.full((len(groups), len(groups)), _HIDDEN)
        self.n_facing, self.n_cast, self.n_seen = np.zeros(
            (3, self._n_groups**2), dtype=np.int64
        )

    def slices(self) -> Iterator[slice]:
        """Yield rows of the matrix, some groups at a time: every block is in one."""
        ends = np.flatnonzero(np.diff(self._groups, append=self._n_groups)) + 1
        start, rows = 0, max(1, _ENTRIES_PER_STEP // len(self._groups))
        while start < len(self._groups):
            last = np.searchsorted(ends, start + rows, side="right") - 1
            stop = int(max(ends[last], ends[np.searchsorted(ends, start + 1)]))
            yield slice(start, stop)
            start = stop

    def cast_probes(self, budget: RayBudget) -> Steps[None]:
        """Find the pairs that face each other, and cast some of each block."""
        probes = []
        for rows in self.slices():
            yield Progress("Lines of sight", 0.0)
            first, second = facing_pairs(
                self._marcher,
                self._samples,
                self._views,
                np.arange(rows.start, rows.stop),
            )
            self.known[first, second] = _UNKNOWN
            blocks = self._blocks_of(first, second)
            self.n_facing += np.bincount(blocks, minlength=len(self.n_facing))
            order = self._rng.permutation(len(blocks))
            order = order[np.argsort(_small(blocks)[order], kind="stable")]
            turns = _places_in_runs(blocks[order])
            early = turns < _MOST_PROBES
            probes.append((first[order[early]], second[order[early]], turns[early]))
        first, second, turns = map(np.concatenate, zip(*probes, strict=True))
        now = turns < _FIRST_PROBES
        yield from within(self._cast(first[now], second[now], budget), 0.1, 0.5)
        now = ~now & self._differing()[self._blocks_of(first, second)]
        yield from within(self._cast(first[now], second[now], budget), 0.5, 1.0)

    def _differing(self) -> NDArray[np.bool_]:
        """Return which blocks differ from a neighbor, or within themselves, (G²,)."""
        cast = self.n_cast.reshape(self._n_groups, -1)
        seen = self.n_seen.reshape(self._n_groups, -1)
        any_seen, any_hidden = seen > 0, seen < cast
        found = []
        for some in (any_seen | any_seen.T, any_hidden | any_hidden.T):
            around = [
                some[self._nearest].any(axis=1),
                some[:, self._nearest].any(axis=2),
            ]
            found.append(around[0] | around[1])
        return (found[0] & found[1]).ravel()

    def cast_mixed(self, budget: RayBudget) -> Steps[None]:
        """Cast the blocks whose probes differ; infer all pairs that are left."""
        mixed = (self.n_seen > 0) & (self.n_seen < self.n_cast)
        n_wanted = int((self.n_facing - self.n_cast)[mixed].sum())
        share = budget.lines_left / max(n_wanted, 1)
        # A block without probes, since the budget was too small, is like the others.
        usual = 2 * int(self.n_seen.sum()) >= int(self.n_cast.sum())
        for rows in self.slices():
            blocks = self._groups[rows, None] * self._n_groups + self._groups
            unknown = self.known[rows] == _UNKNOWN
            first, second = np.nonzero(unknown & mixed[blocks])
            if share < 1:
                chosen = self._rng.random(len(first)) < share
                first, second = first[chosen], second[chosen]
            done, end = (
                1 - (1 - row / len(self._groups)) ** 2
                for row in (rows.start, rows.stop)
            )
            steps = self._cast(first + rows.start, second, budget)
            yield from within(steps, done, end)
            visible = 2 * self.n_seen >= self.n_cast
            visible[self.n_cast == 0] = usual
            answers = np.where(visible, _VISIBLE, _HIDDEN)
            unknown = self.known[rows] == _UNKNOWN
            self.known[rows][unknown] = answers[blocks[unknown]]

    def _cast(
        self, first: NDArray[np.int64], second: NDArray[np.int64], budget: RayBudget
    ) -> Steps[None]:
        """Cast lines between pairs, as far as the budget goes, and note the answers."""
        seen = yield from cast_lines(self._marcher, self._views, first, second, budget)
        first, second = first[: len(seen)], second[: len(seen)]
        self.known[first, second] = np.where(seen, _VISIBLE, _HIDDEN)
        blocks, n_blocks = self._blocks_of(first, second), len(self.n_cast)
        self.n_cast += np.bincount(blocks, minlength=n_blocks)
        self.n_seen += np.bincount(blocks[seen], minlength=n_blocks)

    def _blocks_of(
        self, first: NDArray[np.int64], second: NDArray[np.int64]
    ) -> NDArray[np.int64]:
        """Return the number of each pair's block."""
        return self._groups[first] * self._n_groups + self._groups[second]


def _small(numbers: NDArray[np.int64]) -> NDArray[Any]:
    """Return numbers from 0, in a small type: 16 bits are sorted ten times faster."""
    if len(numbers) == 0:
        return numbers
    from_zero = numbers - numbers.min()
    return from_zero.astype(np.min_scalar_type(from_zero.max()))


def _places_in_runs(values: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the place of each of some sorted values among its equals, from 0."""
    starts = np.flatnonzero(np.diff(values, prepend=-1))
    lengths = np.diff(starts, append=len(values))
    return np.arange(len(values)) - np.repeat(starts, lengths)


def _taken(rows: Rows, order: NDArray[np.int64]) -> Rows:
    """Return some samples or viewpoints, in an order."""
    return replace(
        rows, **{field.name: getattr(rows, field.name)[order] for field in fields(rows)}
    )
