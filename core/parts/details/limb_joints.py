"""Tells which limbs of a shape come apart, at knees or necks: they are alike."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

import numpy as np

from ...steps.arrays import IntArray
from ...steps.progress import Progress, Steps
from .knees import SHARP_TURN, find_knees
from .limb import Joints, limb_of
from .necks import find_necks
from .seen import Count, Demands, seen_beyond
from .surface import PartSurface

Pieces: TypeAlias = tuple[IntArray, IntArray]

# An arc has no knees: pieces beside one see little of each other.
_BESIDE_KNEES = Demands(least_rank=0.6, most_seen=0.5, fewest_samples=10)
# Pieces beside a neck are nearly convex, as beads are. They may well see each other,
# and few samples tell that of a short one.
_BESIDE_NECKS = Demands(least_rank=0.8, most_seen=1.0, fewest_samples=5)
# The limbs of a shape are alike: one has to turn by this much, in radians, or have so
# deep a neck.
_CLEAR_TURN, _CLEAR_DEPTH = 0.87, 1.2
# If so many limbs and this share of them have sharp knees, or so deep a neck, others
# may have a slighter one. One waist may be that of a vase, and two be chance.
_DEPTH = 1.12
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
    cut = _jointed(knees, _CLEAR_TURN, SHARP_TURN, SHARP_TURN)
    straight = {n: found for n, found in necks.items() if n not in cut}
    cut |= _jointed(straight, _CLEAR_DEPTH, _DEPTH)
    return {n: (parts[n][0].kept, joints.pieces) for n, joints in cut.items()}


def _jointed(
    limbs: dict[int, Joints], clear: float, usual: float, least: float = np.inf
) -> dict[int, Joints]:
    """Return the limbs that come apart at joints of a kind.

    Those with joints of size `least` do if one of the limbs has a `clear` joint. All
    that have any do if many have one of the `usual` size, too.
    """
    sizes = {number: max(joints.sizes, default=0.0) for number, joints in limbs.items()}
    if max(sizes.values(), default=0.0) < clear:
        return {}
    n_usual = sum(size >= usual for size in sizes.values())
    if n_usual >= max(_FEWEST_LIMBS, _LEAST_SHARE * len(limbs)):
        least = 0.0
    return {n: limbs[n] for n, size in sizes.items() if size and size >= least}
