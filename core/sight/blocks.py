"""Lines of sight in blocks: few of all pairs are cast, the others follow from them.

Samples that are close and face the same way see much the same. So each pair of samples
has a block of pairs around it: those between the neighbors of one sample and the
neighbors of the other. A few pairs are cast, spread evenly over the LoS matrix. Then,
round by round, more of the pairs are cast whose blocks disagree: they lie along the
borders of what a sample sees. In the end, all other pairs take the answer of their
blocks. Pairs that do not face each other need no ray, and count nowhere.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.spatial import cKDTree

from ..geometry.frames import with_normals
from ..geometry.sampling import Samples
from ..steps.progress import Progress, Steps, within, within_turn
from .lines import RayBudget, cast_lines, faces_inside
from .pair_visibility import PairVisibility
from .viewpoints import Viewpoints

# Pairs of each sample that are cast in the first round, as far as they face each other.
_FIRST_PAIRS = 14
# The rounds that follow: the share of all pairs that may have been cast after each, and
# the mean answer of a block, from −1 for hidden to 1 for visible, between which it is
# doubtful.
_ROUNDS = (
    (0.10, -0.5, 0.6),
    (0.20, -0.4, 0.5),
    (0.35, -0.3, 0.4),
    (0.50, -0.2, 0.3),
    (0.70, -0.15, 0.2),
    (1.00, -0.05, 0.12),
)
# A pair is visible if the mean answer of its block is above this in the end. Just above
# 0, since narrow hidden stretches are overlooked more often than visible ones.
_VISIBLE_FROM = 0.09
# Neighbors of a sample, and itself.
_NEAREST = 14
# Distance that normals one unit apart add, in diagonals.
_WEIGHT_OF_NORMALS = 0.05
# Weight of a sample itself. That of a neighbor is half of it at this distance, in mean
# distances of the three nearest. Sums of weights of blocks are exact in 16 bits.
_WEIGHT, _HALF_WEIGHT_AT = 12, 0.6
# Most rays a sample if the user sets no limit. Only shapes of many shells need more.
_MOST_RAYS = 80
# Entries of the matrix that are looked at in one step, about 10 ms.
_ENTRIES_PER_STEP = 2**19
# A low-discrepancy sequence in two dimensions, as 16-bit fractions (Roberts 2018).
_STRIDES = np.array([37345, 49472], dtype=np.uint16)


def see_blocks(views: Viewpoints, n_rays: int) -> Steps[PairVisibility]:
    """Compute the LoS matrix of all pairs of samples (eq. 3) from rays between some.

    Parameters
    ----------
    views : Viewpoints
        Those of N samples.
    n_rays : int
        Most rays a sample. 0 casts as many as the blocks need.

    Returns
    -------
    Steps of PairVisibility
        A dense matrix (N, N). Every sample sees itself.
    """
    n_samples = len(views.samples)
    budget = RayBudget((n_rays or _MOST_RAYS) * n_samples)
    blocks = _Blocks(views, budget)
    yield from within(blocks.find_facing(), 0.0, 0.1)
    first = min(1.0, 2 * _FIRST_PAIRS / n_samples)
    # A few lines tell how many rays a line takes.
    yield from within(blocks.cast(first / 8, 0.5), 0.1, 0.15)
    yield from within(blocks.cast(first, 0.5), 0.15, 0.3)
    for turn, (share, *doubtful) in enumerate(_ROUNDS):
        last = turn + 1 == len(_ROUNDS)
        steps = blocks.cast(max(first, share), 1.0 if last else 0.5, doubtful)
        yield from within(within_turn(steps, turn, len(_ROUNDS)), 0.3, 0.9)
    answers = yield from within(blocks.infer(), 0.9, 1.0)
    los = (answers > 0).astype(np.float32)
    np.fill_diagonal(los, 1.0)
    n_inferred = int(blocks.facing.sum()) - budget.n_lines
    return PairVisibility(los, None, budget.n_lines, n_inferred)


class _Blocks:
    """The LoS matrix while it is filled.

    Attributes
    ----------
    facing : (N, N) bool
        Which pairs face each other: entries below the diagonal.
    answers : (N, N) int16
        1 for a visible pair, −1 for a hidden one, 0 if it is not known. Symmetric.
    """

    def __init__(self, views: Viewpoints, budget: RayBudget) -> None:
        n_samples = len(views.samples)
        self._views, self._budget = views, budget
        self._weights = _weights_of_neighbors(views.samples, views.marcher.diagonal)
        self.facing = np.zeros((n_samples, n_samples), dtype=bool)
        self.answers = np.zeros(self.facing.shape, dtype=np.int16)

    def _slices(self) -> Iterator[tuple[float, slice, slice]]:
        """Yield some columns at a time, with the rows from the diagonal on.

        The share of the entries that come before is yielded first.
        """
        n_samples, start = len(self.facing), 0
        while start < n_samples:
            stop = start + max(1, _ENTRIES_PER_STEP // n_samples)
            done = 1 - (1 - start / n_samples) ** 2
            yield done, slice(start, n_samples), slice(start, min(stop, n_samples))
            start = stop

    def find_facing(self) -> Steps[None]:
        """Find the pairs that face each other."""
        every = np.arange(len(self.facing))
        for done, rows, columns in self._slices():
            yield Progress("Lines of sight", done)
            pairs = every[rows, None], every[None, columns]
            facing = faces_inside(self._views, *pairs)
            self.facing[rows, columns] = np.tril(facing, -1)

    def cast(
        self, share: float, of_budget: float, doubtful: Sequence[float] = ()
    ) -> Steps[None]:
        """Cast pairs that are not known yet.

        Parameters
        ----------
        share : float
            Only this share of all pairs is looked at, spread evenly over the matrix.
        of_budget : float
            Most rays to cast, as a share of those that are left.
        doubtful : (2,) float, optional
            Least and largest mean answer of the blocks whose pairs are cast, beside
            those of which nothing is known. By default all are.
        """
        found, cast = [], np.abs(self.answers)
        for done, rows, columns in self._slices():
            yield Progress("Lines of sight", 0.3 * done)
            turns = _turns(rows, columns)
            wanted = self.facing[rows, columns] & (cast[rows, columns] == 0)
            wanted &= turns <= np.uint16(share * (2**16 - 1))
            if doubtful:
                votes, n_votes = self._votes(cast, rows, columns)
                least, most = (np.float32(mean) * n_votes for mean in doubtful)
                wanted &= (least <= votes) & (votes <= most)
            second, first = np.divmod(np.flatnonzero(wanted), wanted.shape[1])
            turns = turns[second, first]
            found.append((first + columns.start, second + rows.start, turns))
        first, second, turns = map(np.concatenate, zip(*found, strict=True))
        n_most = max(int(of_budget * self._budget.lines_left), 1)
        if len(turns) > n_most:
            chosen = np.sort(np.argsort(turns, kind="stable")[:n_most])
            first, second = first[chosen], second[chosen]
        steps = cast_lines(self._views, first, second, self._budget)
        seen = yield from within(steps, 0.3, 1.0)
        first, second = first[: len(seen)], second[: len(seen)]
        found_now = np.where(seen, 1, -1)
        self.answers[first, second] = self.answers[second, first] = found_now

    def infer(self) -> Steps[NDArray[np.int16]]:
        """Return `answers`, with one for each pair that faces each other."""
        n_facing, n_known = int(np.count_nonzero(self.facing)), 0
        while True:
            found, cast = np.zeros_like(self.answers), np.abs(self.answers)
            for done, rows, columns in self._slices():
                yield Progress("Lines of sight", done)
                votes, n_votes = self._votes(cast, rows, columns)
                likely = (votes > np.float32(_VISIBLE_FROM) * n_votes).astype(np.int16)
                likely += likely - (n_votes > 0)  # 1, −1, or 0 without a vote
                likely *= self.facing[rows, columns]
                likely *= 1 - cast[rows, columns]
                found[rows, columns] = likely + np.tril(self.answers[rows, columns])
            before, n_known = n_known, int(np.count_nonzero(found))
            if n_known == n_facing:
                return found + found.T
            if n_known == before:  # no ray was cast anywhere near the rest
                found[self.facing & (found == 0)] = 1 if found.sum() >= 0 else -1
            self.answers = found + found.T  # blocks spread into pairs without a vote

    def _votes(
        self, cast: NDArray[np.int16], rows: slice, columns: slice
    ) -> tuple[NDArray[np.int16], NDArray[np.int16]]:
        """Return the sums of the answers in blocks, and how many there may be.

        Answers count by the weights of the two neighbors. `cast` is 1 where there is
        an answer.
        """
        one, other = self._weights[rows], self._weights[columns]
        sums, counts = (one @ (other @ each).T for each in (self.answers, cast))
        return sums, counts


def _turns(rows: slice, columns: slice) -> NDArray[np.uint16]:
    """Return numbers whose pairs below any bound are spread evenly over the matrix."""
    down, across = (
        np.arange(each.start, each.stop).astype(np.uint16) * stride
        for each, stride in zip((rows, columns), _STRIDES, strict=True)
    )
    return np.add.outer(down, across)


def _weights_of_neighbors(samples: Samples, diagonal: float) -> sparse.csr_array:
    """Return the weights of the neighbors of each sample, and of itself, (N, N)."""
    positions, n_samples = samples.positions / diagonal, len(samples)
    # Rounded, or NumPy's version would decide between equal distances.
    places = with_normals(positions, samples.normals, _WEIGHT_OF_NORMALS).round(6)
    n_nearest = min(_NEAREST, n_samples)
    distances, nearest = cKDTree(places).query(places, np.arange(1, n_nearest + 1))
    usual = distances[:, 1:4].mean() if n_samples > 1 else 1.0
    nearness = distances / (_HALF_WEIGHT_AT * max(usual, np.finfo(float).tiny))
    weights = np.maximum(np.round(_WEIGHT / (1 + nearness**2)), 1).astype(np.int16)
    starts = np.arange(0, nearest.size + 1, n_nearest)
    return sparse.csr_array(
        (weights.ravel(), nearest.ravel(), starts), shape=(n_samples, n_samples)
    )
