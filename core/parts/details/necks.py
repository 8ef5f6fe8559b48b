"""Finds the necks of limbs: where these are thinner than on both sides."""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from ...steps.arrays import FloatArray
from .limb import Joints, Limb

# Lengths are in mean radii of the limb. Its thickness is told at places so far apart,
# each the mean over this length to both sides: slices of triangles are ragged.
_STEP, _MEAN = 0.25, 1.0
# A neck is thinner than all within the first of these, and both sides of it are thicker
# within the second. One that narrows over a longer way tapers.
_NEAR, _BESIDE = 1.0, 4.0
# So many times as thick are both sides at least.
_LEAST_DEPTH = 1.06
# Least distance of a neck from another one and from the ends of the limb.
_APART = 2.0
_TINY = np.finfo(float).tiny


def find_necks(limb: Limb) -> Joints:
    """Return the necks of a limb.

    Parameters
    ----------
    limb : Limb

    Returns
    -------
    Joints
        Their sizes are depths: how many times as thick the limb is on both sides.
    """
    n_places = int(limb.length / (_STEP * limb.radius))
    places = _STEP * limb.radius * np.arange(n_places, dtype=np.float64)
    depths = _depths(_thickness(limb, places))
    ends = _APART * limb.radius
    inner = (places >= ends) & (places <= limb.length - ends)
    return limb.joints_at(places[inner], depths[inner], _LEAST_DEPTH, _APART)


def _thickness(limb: Limb, places: FloatArray) -> FloatArray:
    """Return the mean distance of the surface from the middle, around each place.

    Slices across a bent limb are oblique beyond a bend, so that their outline is longer
    there. The distance from the line through the middle is not.
    """
    graph, far, radius = limb.part.graph, limb.far, limb.radius
    away = graph.centers - limb.middle(far)
    along = limb.directions(far - radius, far + radius)
    away -= (away * along).sum(axis=1)[:, None] * along
    order = np.argsort(far, kind="stable")
    areas = graph.areas[order]
    sums = np.cumsum([areas, areas * np.linalg.norm(away, axis=1)[order]], axis=1)
    first, last = (
        np.stack([np.interp(at, far[order], each) for each in sums])
        for at in (places - _MEAN * radius, places + _MEAN * radius)
    )
    area, moment = last - first
    return np.asarray(moment / np.maximum(area, _TINY))


def _depths(thickness: FloatArray) -> FloatArray:
    """Return how many times as thick both sides of each place are, 0 beside necks."""
    near, beside = int(_NEAR / _STEP), int(_BESIDE / _STEP)
    windows = sliding_window_view(np.pad(thickness, near, mode="edge"), 2 * near + 1)
    thinnest = thickness <= windows.min(axis=1)
    sides = sliding_window_view(np.pad(thickness, beside), beside + 1).max(axis=1)
    lower = np.minimum(sides[: len(thickness)], sides[beside:])
    return np.where(thinnest, lower / np.maximum(thickness, _TINY), 0.0)
