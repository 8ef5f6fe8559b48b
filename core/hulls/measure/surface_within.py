"""What of the surface of a solid is within a collision shape."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...geometry.primitives import CollisionShape
from ..convex_hull import THIN
from ..outline import outline_of
from ..solid import Solid

# The surface is within a shape that it is outside of by less: hulls are simplified.
_WITHIN = THIN / 10
# Heights up to this are rounding.
_ABOVE = 1e-9


def surface_within(solid: Solid, shape: CollisionShape) -> NDArray[np.float64]:
    """Return what of the triangles of a solid is within a shape.

    Round shapes count as polyhedra that are a little smaller.

    Parameters
    ----------
    solid : Solid
    shape : CollisionShape
        In the space of the solid.

    Returns
    -------
    (N, 3, 3) float
    """
    (low, high), (lowest, highest) = shape.bounds, solid.bounds
    rows = np.arange(len(solid.corners))
    for axis in range(3):  # at once takes ten times as long
        kept = (lowest[rows, axis] <= high[axis]) & (highest[rows, axis] >= low[axis])
        rows = rows[kept]
    planes = outline_of(shape).planes - [0, 0, 0, _WITHIN]
    return _below_all(planes, solid.corners[rows])


def _below_all(
    planes: NDArray[np.float64], corners: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return what of triangles is below planes (P, 4), in triangles (N, 3, 3).

    Each round cuts every triangle by the plane that it is farthest above.
    """
    found = [corners[:0]]
    while len(corners):
        heights = corners @ planes[:, :3].T + planes[:, 3]
        lowest = heights.min(axis=1).max(axis=1)  # above one plane with all corners
        near = np.flatnonzero(lowest <= _ABOVE)
        highest = heights[near].max(axis=1)
        plane, rows = highest.argmax(axis=1), np.arange(len(near))
        left = highest[rows, plane] > _ABOVE
        found.append(corners[near[~left]])
        corners = _below(corners[near[left]], heights[near[left], :, plane[left]])
    return np.concatenate(found)


def _below(
    corners: NDArray[np.float64], heights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return what of triangles is below a plane each, in triangles (M, 3, 3).

    `heights` (N, 3) are those of the corners: one or two of each are above.
    """
    under = heights <= _ABOVE
    heights = np.where(under, np.minimum(heights, 0.0), heights)
    # The corner alone on its side comes first.
    lone = under.sum(axis=1) == 1
    first = np.where(lone[:, None], under, ~under).argmax(axis=1)
    turn = (first[:, None] + np.arange(3)) % 3
    rows = np.arange(len(corners))[:, None]
    corners, heights = corners[rows, turn], heights[rows, turn]
    alone, others = corners[:, :1], corners[:, 1:]
    share = heights[:, :1] / (heights[:, :1] - heights[:, 1:])
    ends = alone + share[..., None] * (others - alone)
    rest = ~lone
    return np.concatenate(
        [
            np.concatenate([alone, ends], axis=1)[lone],
            np.concatenate([others, ends[:, :1]], axis=1)[rest],
            np.concatenate([others[:, 1:], ends], axis=1)[rest],
        ]
    )
