"""What of the surface of a solid is within a collision shape."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...geometry.primitives import CollisionShape
from ..convex_hull import THIN
from ..solid import Solid
from .fragments import edge_lengths, halved, reach_of

# The surface is within a shape that it is outside of by less: hulls are simplified.
_WITHIN = THIN / 10


def surface_within(
    solid: Solid, shape: CollisionShape
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return triangles of the surface of a solid that are within a shape.

    Parameters
    ----------
    solid : Solid
    shape : CollisionShape
        In the space of the solid.

    Returns
    -------
    small : (N, 3, 3) float
    targets : (N, 3, 3) float
        Triangles within the shape that contain the small ones: the whole triangles of
        the mesh, where possible.
    """
    low, high = shape.bounds
    slack = _WITHIN + solid.grain
    rows = np.arange(len(solid.centers))
    for axis in range(3):  # at once takes ten times as long
        along = solid.centers[rows, axis]
        kept = (low[axis] - slack <= along) & (along <= high[axis] + slack)
        rows = rows[kept]
    if len(rows) == 0:
        return np.zeros((0, 3, 3)), np.zeros((0, 3, 3))
    near = solid.fragments[rows]
    heights = shape.heights(solid.centers[rows])
    whole = heights <= _WITHIN - solid.reach
    unsure = np.flatnonzero(~whole & (heights <= _WITHIN + solid.reach))
    whole[unsure] = _held(shape, near[unsure]).all(axis=1)
    cut = unsure[~whole[unsure]]
    # Large triangles that are within stand for their pieces.
    numbers, places = np.unique(solid.origins[rows][whole], return_inverse=True)
    large = solid.corners[numbers]
    places = places.reshape(-1)
    of_large = np.all(_held(shape, large), axis=1).take(places)
    targets = np.where(of_large[:, None, None], large[places], near[whole])
    pieces = _pieces_within(shape, near[cut], solid.grain / 4)
    return np.concatenate([near[whole], pieces]), np.concatenate([targets, pieces])


def _pieces_within(
    shape: CollisionShape, corners: NDArray[np.float64], longest: float
) -> NDArray[np.float64]:
    """Return what of triangles is within a shape, in pieces (N, 3, 3).

    Of pieces with edges no longer than `longest`, it is the corners within.
    """
    found = [corners[:0]]
    while len(corners):
        held = _held(shape, corners)
        done = held.all(axis=1) | (edge_lengths(corners).max(axis=1) <= longest)
        taken = done & held.any(axis=1)
        order = np.argsort(~held[taken], axis=1, kind="stable")
        within = np.take_along_axis(held[taken], order, axis=1)
        chosen = np.where(within, order, order[:, :1])
        found.append(np.take_along_axis(corners[taken], chosen[..., None], axis=1))
        centers, radii = reach_of(corners)
        beyond = shape.heights(centers) > _WITHIN + radii
        corners = halved(corners[~done & ~beyond])
    return np.concatenate(found)


def _held(shape: CollisionShape, corners: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which corners of triangles are within a shape, (N, 3)."""
    heights = shape.heights(corners.reshape(-1, 3)).reshape(-1, 3)
    held: NDArray[np.bool_] = heights <= _WITHIN
    return held
