"""Matches the parts of a new run with those before, by the area that they share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment
from scipy.sparse import coo_array

from ..steps.arrays import BoolArray, IntArray
from .editing import compacted


def match_parts(
    before: NDArray[np.integer], after: NDArray[np.integer], areas: NDArray[np.floating]
) -> IntArray:
    """Find the former part that each new part continues.

    Each former part is continued by one new part at most, such that the area that
    keeps its part is as large as possible: an optimal assignment.

    Parameters
    ----------
    before, after : (P,) int
        Former and new part of each polygon, or point. Labels count from 0.
    areas : (P,) float
        Area of each polygon in any unit; ones for points.

    Returns
    -------
    former : (K,) int
        For each new label, the former label that it continues; −1 for a new part.
    """
    shared = coo_array((areas.astype(np.float64), (after, before))).toarray()
    former = np.full(len(shared), -1, dtype=np.int64)
    new, old = linear_sum_assignment(shared, maximize=True)
    touching = shared[new, old] > 0
    former[new[touching]] = old[touching]
    return former


def given_back(
    before: NDArray[np.integer],
    after: NDArray[np.integer],
    areas: NDArray[np.floating],
    by_hand: BoolArray,
) -> IntArray:
    """Give polygons that the user settled back to their parts, after a new run.

    Such a polygon goes to the new part that continues its former one, or stays a part
    with the others of it, if no new part does.

    Parameters
    ----------
    before, after : (P,) int
        Former and new part of each polygon, or point. Labels count from 0.
    areas : (P,) float
    by_hand : (P,) bool
        The polygons that the user settled.

    Returns
    -------
    labels : (P,) int
        In 0…K − 1, each used.
    """
    free = ~by_hand
    labels = after.astype(np.int64)
    if free.any():
        former = match_parts(before[free], after[free], areas[free])
    else:
        former = np.empty(0, dtype=np.int64)
    following = np.arange(before.max() + 1) + after.max() + 1  # parts of their own
    matched = np.flatnonzero(former >= 0)
    following[former[matched]] = matched
    labels[by_hand] = following[before[by_hand]]
    return compacted(labels)[0]
