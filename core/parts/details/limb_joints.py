"""Tells which limbs of a shape come apart, at knees or necks: they are alike."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from .knees import find_knees
from .limb import Joints, limb_of
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
        self._nodes: dict[int, NDArray[np.int64]] = {}
        self._knees: dict[int, Joints] = {}
        self._necks: dict[int, Joints] = {}

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
        self._nodes[number] = part.kept
        self._necks[number] = seen_beyond(find_necks(limb), count, _BESIDE_NECKS)
        if self._bends:
            self._knees[number] = seen_beyond(find_knees(limb), count, _BESIDE_KNEES)

    def cut(self) -> dict[int, Pieces]:
        """Return the limbs that come apart.

        Returns
        -------
        dict of int to ((M,) int, (M,) int)
            From the number of each limb to its nodes, and the piece of each; 0 is the
            one at the seams.
        """
        cut = {number: knees for number, knees in self._knees.items() if knees.sizes}
        if max(map(_clearest, cut.values()), default=0.0) < _CLEAR_TURN:
            cut = {}
        straight = {n: necks for n, necks in self._necks.items() if n not in cut}
        depths = np.array([_clearest(necks) for necks in straight.values()])
        fewest = max(_FEWEST_LIMBS, _LEAST_SHARE * len(depths))
        if (depths >= _DEPTH).sum() >= fewest and depths.max() >= _CLEAR_DEPTH:
            cut |= {n: necks for n, necks in straight.items() if necks.sizes}
        return {n: (self._nodes[n], joints.pieces) for n, joints in cut.items()}


def _clearest(joints: Joints) -> float:
    """Return the size of the clearest joint, 0 without one."""
    return max(joints.sizes, default=0.0)
