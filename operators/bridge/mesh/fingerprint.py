"""Which faces a figure was measured on, and whether these are still there.

A fingerprint is the number of faces, their area and their center.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import bpy
import numpy as np

from ....core.steps.arrays import FloatArray
from .by_label import sums_of_all

# Where what is noted of some faces keeps their fingerprint.
MEASURED_ON = "measured_on"
# Faces are the same if their area, and their center in lengths of the root of that
# area, differ by no more than this.
_SAME = 1e-3
# Digits that are noted of an area, and of a center in lengths of the root of the area.
_DIGITS = 5


def fingerprint_of(obj: bpy.types.Object) -> list[float]:
    """Return the fingerprint of all faces, or points, of an object, to be noted."""
    return to_be_noted(sums_of_all(obj))


def to_be_noted(sums: FloatArray) -> list[float]:
    """Return a fingerprint, (5,), in as few digits as tell faces from others.

    Edit Mode computes areas a little otherwise, and must give the same.
    """
    n_faces, area, *center = sums.tolist()
    digits = _DIGITS - math.ceil(math.log10(area) / 2) if area else _DIGITS
    return [n_faces, float(f"{area:.{_DIGITS}g}"), *(round(x, digits) for x in center)]


def together(sums: FloatArray) -> FloatArray:
    """Return the fingerprint, (5,), of the faces of several ones, (K, 5), together."""
    total = sums.sum(axis=0)
    total[2:] = sums[:, 1] @ sums[:, 2:] / max(total[1], np.finfo(float).tiny)
    return total


def fits(noted: Mapping[str, Any], now: FloatArray) -> bool:
    """Return whether what is noted was measured on faces with this fingerprint."""
    then = noted.get(MEASURED_ON)
    if then is None or then[0] != now[0]:
        return False
    area, width = now[1], np.sqrt(now[1])
    changed, moved = abs(then[1] - area), np.abs(np.subtract(then[2:], now[2:])).max()
    # Far from the origin, Edit Mode rounds more.
    rounding = np.finfo(np.float32).eps * np.abs(now[2:]).max()
    return bool(
        changed <= _SAME * area + rounding * width and moved <= _SAME * width + rounding
    )
