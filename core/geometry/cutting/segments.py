"""Clip line segments to a space between planes."""

from __future__ import annotations

import numpy as np

from ...steps.arrays import FloatArray
from ..frames import heights_above


def segments_below(planes: FloatArray, segments: FloatArray) -> FloatArray:
    """Return what is below all planes of line segments.

    Parameters
    ----------
    planes : (P, 4) float
        n · x + d ≤ 0 below each.
    segments : (S, 2, 3) float
        Both ends of each.

    Returns
    -------
    (M, 2, 3) float
        In their order. Of one that only touches the space, both ends are the same.
    """
    starts, ends = (heights_above(planes, segments[:, end]).T for end in (0, 1))
    fall = np.where(starts == ends, 1.0, starts - ends)
    crossed = starts / fall
    enter = np.where(starts > 0, crossed, 0.0).max(axis=0, initial=0.0)
    leave = np.where(ends > 0, crossed, 1.0).min(axis=0, initial=1.0)
    enter[((starts > 0) & (ends > 0)).any(axis=0)] = np.inf
    kept = enter <= leave
    shares = np.stack([enter, leave], axis=1)[kept, :, None]
    one, other = segments[kept, :1], segments[kept, 1:]
    clipped: FloatArray = one + shares * (other - one)
    return clipped
