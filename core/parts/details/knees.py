"""Finds the knees of limbs: where the line through their middle turns at once."""

from __future__ import annotations

import numpy as np

from .limb import Joints, Limb

# How far from a knee its two directions are told, in radii, so that a knee differs from
# an arc.
_FROM, _TO = 0.5, 3.0
# Least turn at a sharp knee, in radians, and at the slight one of a limb without.
SHARP_TURN, _SLIGHT_TURN = 0.7, 0.55
# Least distance of a knee from another one and from the ends of the limb, in radii.
_APART = 2.5


def find_knees(limb: Limb) -> Joints:
    """Return the knees of a limb, or slight ones if it has no sharp ones.

    Parameters
    ----------
    limb : Limb

    Returns
    -------
    Joints
        Their sizes are turns in radians.
    """
    radius, ends = limb.radius, _APART * limb.radius
    n_places = max(int(4 * (limb.length / radius - 2 * _APART)), 0)
    places = np.linspace(ends, limb.length - ends, n_places)
    before = limb.directions(places - _TO * radius, places - _FROM * radius)
    after = limb.directions(places + _FROM * radius, places + _TO * radius)
    cosines = (before * after).sum(axis=1)
    turns = np.arccos(np.clip(cosines, -1.0, 1.0))
    knees = limb.joints_at(places, turns, SHARP_TURN, _APART)
    return knees if knees.sizes else limb.joints_at(places, turns, _SLIGHT_TURN, _APART)
