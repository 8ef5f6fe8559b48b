"""Search patches of a surface for the largest value of a function on them.

Patches are halved until no point of them can have a much larger value than the largest
that is known.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ...geometry.cutting.halving import edge_lengths, halved
from ...geometry.frames import settled
from ...steps.arrays import FloatArray, IntArray

# Patches looked at in one round; with more to halve, the highest ones go first.
_MOST_PATCHES = 60_000
# With so many patches in all, bounds stand as they are.
_MOST_IN_ALL = 240_000
# Fewer patches are halved again before they are looked at, so many times more: a round
# takes as long for one as for some hundreds.
_FEW_PATCHES, _HALVINGS = 400, 2

# Bounds of patches (N, 3, 3): what is surely reached, and what is surely not exceeded.
Bounds: TypeAlias = tuple[FloatArray, FloatArray]


class PatchSearch:
    """Patches of a surface, and what is known of a function on them.

    Parameters
    ----------
    corners : (N, 3, 3) float
        Corners of the first patches, which are triangles.

    Attributes
    ----------
    place : (1, 3) or (0, 3) float
        Where the largest known value is reached, if it was told apart.
    """

    def __init__(self, corners: FloatArray) -> None:
        self.place = np.zeros((0, 3))
        self._corners = corners
        self._high = np.full(len(corners), np.inf)
        self._reached = 0.0

    def largest(
        self,
        bounds_of: Callable[[FloatArray, float], Bounds],
        enough: float,
        limit: float,
        tolerance: float,
    ) -> float:
        """Return an upper bound of the largest value; go on where the last call ended.

        Parameters
        ----------
        bounds_of : callable
            Returns bounds of the values on patches. Those that are no higher than the
            second argument need not be sharp.
        enough : float
            Values below it are not told apart.
        limit : float
            Values above it are not told apart either: the search ends there.
        tolerance : float
            The bound exceeds the largest value by this share at most, where there is
            time for it.

        Returns
        -------
        float
        """
        while True:
            level = max(min(self._reached * (1 + tolerance), limit), enough)
            rows = self._next_rows(level)
            if len(rows) == 0 or self._reached > limit:
                return self._bound
            corners = _smaller(self._corners[rows], self._high[rows])
            low, high = bounds_of(corners, level)
            if low.max() > max(self._reached, enough):
                self.place = corners[[settled(low).argmax()]].mean(axis=1)
            self._reached = max(self._reached, float(low.max()))
            others = np.delete(self._corners, rows, axis=0)
            self._corners = np.concatenate([others, corners])
            self._high = np.concatenate([np.delete(self._high, rows), high])

    @property
    def _bound(self) -> float:
        """No value is surely larger, if all patches were looked at once."""
        known = self._high[np.isfinite(self._high)]
        return max(self._reached, float(known.max(initial=0.0)))

    def _next_rows(self, level: float) -> IntArray:
        """Return the rows of patches to look at next, so that none is above a level.

        First those that nothing is known of. Then all that are above the level, or the
        highest ones if these are too many. None if there are too many patches in all.
        """
        new = np.flatnonzero(np.isinf(self._high))[:_MOST_PATCHES]
        if len(new):
            return new
        far = self._high > level
        if far.sum() > _MOST_PATCHES:
            far = self._high > self._high.max() / 2
        rows = np.flatnonzero(far)
        return rows if len(rows) + len(self._high) <= _MOST_IN_ALL else rows[:0]


def _smaller(corners: FloatArray, high: FloatArray) -> FloatArray:
    """Return halves of patches, or the patches if nothing is known of them yet."""
    if np.isinf(high).all():
        return corners
    corners = halved(corners, edge_lengths(corners))
    for _ in range(_HALVINGS):
        if len(corners) < _FEW_PATCHES:
            corners = halved(corners, edge_lengths(corners))
    return corners
