"""How often triangles wind around a point."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.frames import cross


def winding_number(
    point: NDArray[np.float64],
    corners: NDArray[np.float64],
    signs: NDArray[np.float64],
) -> float:
    """Return how often triangles wind around a point.

    A sum of solid angles, by the formula of Van Oosterom and Strackee (1983).

    Parameters
    ----------
    point : (3,) float
    corners : (T, 3, 3) float
        Corners of the triangles.
    signs : (T,) float
        -1 for triangles to be turned, 1 for others.

    Returns
    -------
    float
        1 within a closed surface that faces outwards, 0 outside.
    """
    a, b, c = np.moveaxis(corners - point, 1, 0)
    la, lb, lc = (np.linalg.norm(edge, axis=1) for edge in (a, b, c))
    above = np.einsum("td,td->t", a, cross(b, c))
    below = (
        la * lb * lc
        + (a * b).sum(axis=1) * lc
        + (b * c).sum(axis=1) * la
        + (c * a).sum(axis=1) * lb
    )
    return float((signs * np.arctan2(above, below)).sum() / (2 * np.pi))
