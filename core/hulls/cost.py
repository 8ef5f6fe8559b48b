"""What hulls cost: their errors, and the volume that they add.

Errors alone cannot tell a snug hull from one that fills what is thin.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .convex_hull import hull_volume
from .piece import Piece, volume_error

# Error that adding the whole volume of the solid is worth.
_PRICE = 1.0
# Errors of joints cost by this power, 1 at the large one: the largest of all hulls'
# errors is what counts, and small ones hardly matter.
_LARGE = 0.07
_POWER = 4


def cost_of_sides(one: Piece, other: Piece, solid_volume: float) -> float:
    """Return what the hulls of both sides of a cut cost."""
    errors = np.hypot(one.error, other.error)
    return _rounded(errors + _price_of_sides(one, other, solid_volume))


def least_cost_of_sides(one: Piece, other: Piece, solid_volume: float) -> float:
    """Return what both sides of a cut cost at least: as far as their volumes tell.

    The other term of their errors takes as long as all the rest.
    """
    errors = np.hypot(one.volume_error, other.volume_error)
    return _rounded(errors + _price_of_sides(one, other, solid_volume))


def cost_of_joint(joint: Piece, solid_volume: float) -> float:
    """Return what the hull of two pieces as one costs."""
    price = _price(joint.added_volume, solid_volume)
    return _rounded((joint.error / _LARGE) ** _POWER + price)


def least_cost(one: Piece, other: Piece, solid_volume: float) -> float:
    """Return what two pieces as one cost at least: as far as their volume tells.

    The other term of their error takes far longer.
    """
    points = np.concatenate([one.hull.vertices, other.hull.vertices])
    added = hull_volume(points) - one.volume - other.volume
    error = volume_error(added)
    return _rounded((error / _LARGE) ** _POWER + _price(added, solid_volume))


def _price_of_sides(one: Piece, other: Piece, solid_volume: float) -> float:
    """Return what the volume added on both sides of a cut costs."""
    added = max(one.added_volume, 0.0) + max(other.added_volume, 0.0)
    return _price(added, solid_volume)


def _price(added: float, solid_volume: float) -> float:
    """Return what an added volume costs; nothing where the solid has none."""
    return _PRICE * max(added, 0.0) / solid_volume if solid_volume > 0 else 0.0


def _rounded(cost: float | np.floating[Any]) -> float:
    """Return a cost without the noise that would choose between what is alike."""
    return round(float(cost), 6)
