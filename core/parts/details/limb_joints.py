"""Tells which limbs of a shape come apart, at knees or necks: they are alike."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...steps.progress import Progress, Steps
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


def cut_limbs(
    parts: Mapping[int, tuple[PartSurface, Count]], bends: bool
) -> Steps[dict[int, Pieces]]:
    """Find the limbs of a shape that come apart.

    Parameters
    ----------
    parts : dict of int to (PartSurface, callable)
        By number. The callable counts pairs of samples by labels of the part's nodes.
    bends : bool
        Whether limbs come apart at knees, too.

    Returns
    -------
    Steps of dict of int to ((M,) int, (M,) int)
        From the number of each limb to its nodes, and the piece of each; 0 is the one
        at the seams.
    """
    knees: dict[int, Joints] = {}
    necks: dict[int, Joints] = {}
    for number, (part, count) in parts.items():
        yield Progress("Details", 1.0)
        if limb := limb_of(part):
            necks[number] = seen_beyond(find_necks(limb), count, _BESIDE_NECKS)
            if bends:
                knees[number] = seen_beyond(find_knees(limb), count, _BESIDE_KNEES)
    cut = {number: found for number, found in knees.items() if found.sizes}
    if max(map(_clearest, cut.values()), default=0.0) < _CLEAR_TURN:
        cut = {}
    straight = {n: found for n, found in necks.items() if n not in cut}
    depths = np.array(list(map(_clearest, straight.values())))
    fewest = max(_FEWEST_LIMBS, _LEAST_SHARE * len(depths))
    if (depths >= _DEPTH).sum() >= fewest and depths.max() >= _CLEAR_DEPTH:
        cut |= {n: found for n, found in straight.items() if found.sizes}
    return {n: (parts[n][0].kept, joints.pieces) for n, joints in cut.items()}


def _clearest(joints: Joints) -> float:
    """Return the size of the clearest joint, 0 without one."""
    return max(joints.sizes, default=0.0)
