"""Finds the spikes of parts, such as the antennae of a head or the tail of a body."""

from __future__ import annotations

import numpy as np

from ...steps.arrays import FloatArray, IntArray
from .surface import PartSurface

# A spike is long if its squared length is at least its area, as that of a cylinder six
# times as long as its radius. With 0.4, noses, heels and the corners of boxes are.
_LONG = 1.0
# It ends where the surface widens: the next quarter of its length has this many times
# the area of the last one. In a cone, that ratio is 1.3.
_WIDENS = 1.6
_NEXT = 0.25
# Largest share of the area of its part. A larger one is no spike of it.
_MOST_SHARE = 0.33
# Smaller spikes are roughness.
_LEAST_NODES = 12
# Least height of a tip over the way to a farther one, as a share of the largest
# distance from the seams. So many tips are looked at.
_LEAST_TIP = 0.1
_MOST_TIPS = 6
# Lengths that are tried, as shares of the largest distance from the tip.
_LENGTHS = np.linspace(0.05, 0.95, 73)
_TINY = np.finfo(float).tiny


def find_spikes(part: PartSurface, least_area: float) -> list[IntArray]:
    """Return the long thin prongs of a part that widen where they end.

    Parameters
    ----------
    part : PartSurface
    least_area : float
        Smaller ones are left out.

    Returns
    -------
    list of (S,) int
        Nodes of each spike, as numbered in the part. No two spikes share a node.
    """
    taken = np.zeros(len(part.kept), dtype=bool)
    found = []
    tips = part.tips(_LEAST_TIP * float(part.far.max()), _MOST_TIPS)
    for far in part.from_nodes(tips):
        spike = _spike_at(part, far, least_area)
        if len(spike) and not taken[spike].any():
            taken[spike] = True
            found.append(spike)
    return found


def _spike_at(part: PartSurface, far: FloatArray, least_area: float) -> IntArray:
    """Return the nodes of the spike at a tip that all are so `far` from, or none."""
    order = np.argsort(far, kind="stable")
    reached, areas = far[order], np.cumsum(part.graph.areas[order])

    def within(lengths: FloatArray) -> FloatArray:
        rows = np.searchsorted(reached, lengths, side="right")
        return np.where(rows > 0, areas[rows - 1], 0.0)

    lengths = _LENGTHS * far.max()
    area = within(lengths)
    last = area - within((1 - _NEXT) * lengths)
    widening = (within((1 + _NEXT) * lengths) - area) / np.maximum(last, _TINY)
    fits = (lengths**2 >= _LONG * area) & (area <= _MOST_SHARE * areas[-1])
    fits &= (area >= least_area) & (widening >= _WIDENS)
    if not fits.any():
        return order[:0]
    base = np.where(fits, widening, 0.0).argmax()
    spike = order[reached <= lengths[base]]
    return spike if len(spike) >= _LEAST_NODES else order[:0]
