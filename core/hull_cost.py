"""What hulls cost: their errors, and the volume that they add.

Errors alone cannot tell a snug hull from one that fills what is thin.
"""

from __future__ import annotations

import numpy as np

from .hull import hull_volume
from .piece import Piece, volume_error

# Error that adding the whole volume of the solid is worth.
_PRICE = 1.0
# A usual error: larger ones cost more than their share where pieces are joined, since
# the largest of all is what counts.
_USUAL = 0.05


def cost_of_sides(one: Piece, other: Piece, solid_volume: float) -> float:
    """Return what the hulls of both sides of a cut cost."""
    errors = one.error + other.error
    return _rounded(errors + _price_of_sides(one, other, solid_volume))


def least_cost_of_sides(one: Piece, other: Piece, solid_volume: float) -> float:
    """Return what both sides of a cut cost at least: as far as their volumes tell.

    The other term of their errors takes as long as all the rest.
    """
    errors = one.volume_error + other.volume_error
    return _rounded(errors + _price_of_sides(one, other, solid_volume))


def cost_of_joint(joint: Piece, solid_volume: float) -> float:
    """Return what the hull of two pieces as one costs."""
    price = _price(joint.added_volume, solid_volume)
    return _rounded(joint.error**2 / _USUAL + price)


def least_cost(one: Piece, other: Piece, solid_volume: float) -> float:
    """Return what two pieces as one cost at least: as far as their volume tells.

    The other term of their error takes far longer.
    """
    points = np.concatenate([one.hull.vertices, other.hull.vertices])
    added = hull_volume(points) - one.volume - other.volume
    return _rounded(volume_error(added) ** 2 / _USUAL + _price(added, solid_volume))


def _price_of_sides(one: Piece, other: Piece, solid_volume: float) -> float:
    """Return what the volume added on both sides of a cut costs."""
    added = max(one.added_volume, 0.0) + max(other.added_volume, 0.0)
    return _price(added, solid_volume)


def _price(added: float, solid_volume: float) -> float:
    """Return what an added volume costs; nothing where the solid has none."""
    return _PRICE * max(added, 0.0) / solid_volume if solid_volume > 0 else 0.0


def _rounded(cost: float) -> float:
    """Return a cost without the noise that would choose between what is alike."""
    return round(cost, 6)
