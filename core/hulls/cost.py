"""Costs by which cuts and joints are compared: errors of hulls and added volume.

Errors alone cannot tell a tight hull from one that fills a thin gap. Of cuts that are
equally good otherwise, the smallest costs least.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .convex_hull import hull_volume
from .cutting.cell import Cell
from .measure.estimate import volume_error
from .piece import Piece

# Cost of hulls that add as much volume as the whole solid has, in units of error.
_PRICE = 1.0
# Cost of a cut as large as the surface of the solid.
_PRICE_OF_CUT = 0.2
# The error of a joint costs (error / _LARGE) ** _POWER. The largest error of all hulls
# is the one that counts, so small errors cost almost nothing.
_LARGE = 0.07
_POWER = 4
# Norm of the errors of both sides of a cut. By a higher one, cuts through the middle of
# a gap seem better than those beside it, which leave one side convex.
_NORM = 1.75
# Costs are rounded, so that noise does not decide between equal ones.
_DIGITS = 6
COST_STEP = 10.0**-_DIGITS


def cost_of_sides(
    sides: tuple[Cell, Cell], errors: Sequence[float], solid_volume: float
) -> float:
    """Return the cost of the hulls of both sides of a cut.

    Parameters
    ----------
    sides : tuple of two Cells
    errors : sequence of two floats
        Their errors. Lower bounds of these give a lower bound of the cost: how far
        points on hulls are from the surface takes as long to compute as all the rest.
    solid_volume : float
        Volume of the whole solid.

    Returns
    -------
    float
        A norm of both errors, plus the price of the added volume and of the cut.
    """
    added = sum(max(side.added_volume, 0.0) for side in sides)
    cuts = sum(side.cut_share for side in sides)
    price = _price(added, solid_volume) + _PRICE_OF_CUT * cuts / 2
    return _rounded(np.linalg.norm(errors, _NORM) + price)


def cost_of_joint(joint: Piece, error: float, solid_volume: float) -> float:
    """Return the cost of the hull of two joined pieces.

    Parameters
    ----------
    joint : Piece
        The two pieces as one.
    error : float
        Its error, estimated or stated.
    solid_volume : float
        Volume of the whole solid.

    Returns
    -------
    float
    """
    price = _price(joint.added_volume, solid_volume)
    return _rounded((error / _LARGE) ** _POWER + price)


def error_of_joint(joint: Piece, cost: float, solid_volume: float) -> float:
    """Return the error with which a joint has a cost: the inverse of `cost_of_joint`.

    Parameters
    ----------
    joint : Piece
        The two pieces as one.
    cost : float
    solid_volume : float
        Volume of the whole solid.

    Returns
    -------
    float
        0 if it costs more with any error.
    """
    left = cost - _price(joint.added_volume, solid_volume)
    return float(_LARGE * max(left, 0.0) ** (1 / _POWER))


def least_cost(one: Piece, other: Piece, solid_volume: float) -> float:
    """Return a lower bound of `cost_of_joint` of hulls, found from volumes alone.

    The other term of the error, the Hausdorff distance, takes far longer to compute.

    Parameters
    ----------
    one, other : Piece
        Pieces that are not joined yet.
    solid_volume : float
        Volume of the whole solid.

    Returns
    -------
    float
    """
    points = np.concatenate([one.extremes, other.extremes])
    added = hull_volume(points) - one.volume - other.volume
    error = volume_error(added)
    return _rounded((error / _LARGE) ** _POWER + _price(added, solid_volume))


def _price(added: float, solid_volume: float) -> float:
    """Return the price of an added volume; 0 if the solid has no volume."""
    return _PRICE * max(added, 0.0) / solid_volume if solid_volume > 0 else 0.0


def _rounded(cost: float | np.floating[Any]) -> float:
    """Return a rounded cost."""
    return round(float(cost), _DIGITS)
