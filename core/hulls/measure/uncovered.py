"""How far points of a piece are from the collision shape around it."""

from __future__ import annotations

import numpy as np

from ...geometry.frames import heights_above
from ...geometry.primitives import CollisionShape, Hull
from ...steps.rows import blocks
from .fragments import distances_to

# Largest number of point-triangle pairs at once.
_MOST_PAIRS = 400_000


def uncovered(shape: CollisionShape, hull: Hull) -> float:
    """Return the largest distance from a collision shape of a point of a hull.

    Parameters
    ----------
    shape : CollisionShape
    hull : Hull

    Returns
    -------
    float
        0 if the shape contains the hull. A corner is the farthest point: distances
        from a convex shape are convex.
    """
    heights = shape.heights(hull.vertices)
    if shape.kind != "HULL":
        return float(max(heights.max(), 0.0))
    points = hull.vertices[heights > 0]
    corners, farthest = shape.hull.corners, 0.0
    for block in blocks(len(points), _MOST_PAIRS // len(corners)):
        some = points[block]
        # The nearest point of a convex shape is on a face that is seen from outside.
        rows, faces = np.nonzero(heights_above(shape.hull.planes, some) > 0)
        nearest = np.full(len(some), np.inf)
        np.minimum.at(nearest, rows, distances_to(some[rows], corners[faces]))
        farthest = max(farthest, float(nearest[np.isfinite(nearest)].max(initial=0.0)))
    return farthest
