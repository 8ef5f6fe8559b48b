"""Tells which limbs of a shape come apart, at knees or necks: they are alike."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from .knees import find_knees
from .limb import limb_of
from .necks import find_necks
from .seen import Count, Demands, seen_beyond
from .surface import PartSurface

Pieces: TypeAlias = tuple[NDArray[np.int64], NDArray[np.int64]]

# An arc has no knees: pieces beside one see little of each other.
_BESIDE_KNEES = Demands(least_rank=0.6, most_seen=0.5, fewest_samples=10)
# Pieces beside a neck are nearly convex, as beads are. They may well see each other,
# and few samples tell that of a short one.
_BESIDE_NECKS = Demands(least_rank=0.8, most_seen=1.0, fewest_samples=5)
# The limbs of a shape bend alike: one has to turn by this much, in radians.
_CLEAR_TURN = 0.87
# They have necks alike: one of them has to be so deep, and those of so many limbs and
# this share of them so deep. One waist may be that of a vase, and two be chance.
_CLEAR_DEPTH, _DEPTH = 1.2, 1.12
_FEWEST_LIMBS, _LEAST_SHARE = 3, 0.5


class LimbJoints:
    """The joints of the limbs of one shape.

    Parameters
    ----------
    bends : bool
        Whether limbs come apart at knees, too.
    """

    def __init__(self, bends: bool) -> None:
        self._bends = bends
        self._bent: dict[int, Pieces] = {}
        self._necked: dict[int, Pieces] = {}
        self._turns: list[float] = []
        self._depths: list[float] = []

    def add(self, number: int, part: PartSurface, count: Count) -> None:
        """Look for joints of a part, if it is a limb.

        Parameters
        ----------
        number : int
            Of the part.
        part : PartSurface
        count : callable
            Counts pairs of samples by labels of the part's nodes.
        """
        limb = limb_of(part)
        if limb is None:
            return
        if self._bends:
            knees = seen_beyond(find_knees(limb), count, _BESIDE_KNEES)
            if knees.sizes:
                self._bent[number] = part.kept, knees.pieces
                self._turns.append(max(knees.sizes))
                return
        necks = seen_beyond(find_necks(limb), count, _BESIDE_NECKS)
        self._depths.append(max(necks.sizes, default=0.0))
        if necks.sizes:
            self._necked[number] = part.kept, necks.pieces

    def cut(self) -> dict[int, Pieces]:
        """Return the limbs that come apart.

        Returns
        -------
        dict of int to ((M,) int, (M,) int)
            From the number of each limb to its nodes, and the piece of each; 0 is the
            one at the seams.
        """
        bent = self._bent if max(self._turns, default=0.0) >= _CLEAR_TURN else {}
        n_deep = sum(depth >= _DEPTH for depth in self._depths)
        alike = n_deep >= max(_FEWEST_LIMBS, _LEAST_SHARE * len(self._depths))
        clear = max(self._depths, default=0.0) >= _CLEAR_DEPTH
        return bent | self._necked if alike and clear else dict(bent)
