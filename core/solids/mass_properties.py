"""Mass, center of mass and inertia of rigid bodies, one or several together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..steps.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class MassProperties:
    """Mass, center of mass and inertia of a rigid body.

    Attributes
    ----------
    mass : float
        In kilograms if the density is in kilograms per cubed unit.
    center : (3,) float
        Center of mass, in units.
    inertia : (3, 3) float
        Inertia tensor about the center of mass, mass times squared units. Products of
        inertia are negative: I_xy = -∫ x y dm.
    """

    mass: float
    center: FloatArray
    inertia: FloatArray


def combined_mass(bodies: Sequence[MassProperties]) -> MassProperties:
    """Return the mass properties of bodies that are fixed to each other.

    Parameters
    ----------
    bodies : sequence of MassProperties
        One or more. Where two of them overlap, both count.

    Returns
    -------
    MassProperties
    """
    masses = np.array([body.mass for body in bodies])
    centers = np.array([body.center for body in bodies])
    center = masses @ centers / masses.sum()
    inertia = np.zeros((3, 3))
    for body, arm in zip(bodies, centers - center, strict=True):
        # The parallel axis theorem.
        inertia += body.inertia
        inertia += body.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return MassProperties(float(masses.sum()), center, inertia)
