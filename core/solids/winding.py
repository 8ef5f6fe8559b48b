"""Sides of triangles and their corners, and how triangles wind around a point."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.mesh import TriangleMesh
from ..steps.progress import Progress, Steps
from ..steps.rows import blocks


def sides_forward(mesh: TriangleMesh) -> Steps[NDArray[np.bool_]]:
    """Return the sides that run from the lower to the higher place.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    Steps of (3T,) bool
        Side 3t + i of triangle t runs from its corner i to the next one.
    """
    corners = mesh.welded_triangles
    forward = np.empty(corners.size, dtype=bool)
    for rows in blocks(len(corners)):
        yield Progress("Surface", rows.start / len(corners))
        some, along = corners[rows], forward[3 * rows.start : 3 * rows.stop]
        np.less(some, some[:, [1, 2, 0]], out=along.reshape(-1, 3))
    return forward


def corners_of(mesh: TriangleMesh, sides: NDArray[np.int32]) -> NDArray[np.float64]:
    """Return where sides of triangles start and end, and the corners opposite.

    Parameters
    ----------
    mesh : TriangleMesh
    sides : (E, H) int

    Returns
    -------
    (3, E, H, 3) float
    """
    columns = (sides % 3 + np.arange(3)[:, None, None]) % 3
    return mesh.vertices[mesh.triangles[sides // 3, columns]]


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
    above = np.einsum("td,td->t", a, np.cross(b, c))
    below = (
        la * lb * lc
        + (a * b).sum(axis=1) * lc
        + (b * c).sum(axis=1) * la
        + (c * a).sum(axis=1) * lb
    )
    return float((signs * np.arctan2(above, below)).sum() / (2 * np.pi))
