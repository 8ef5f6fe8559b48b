"""What of the surface of a solid is within a collision shape."""

from __future__ import annotations

import numpy as np

from ...geometry.frames import HEIGHTS_AT_ONCE, heights_above
from ...geometry.primitives import CollisionShape
from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.rows import blocks
from ..convex_hull import LEFT_OUT
from ..outline import outline_of
from ..solid import Solid

# Heights up to this are rounding.
_ABOVE = 1e-9


def surface_within(solid: Solid, shape: CollisionShape) -> FloatArray:
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
    (low, high), (lowest, highest) = shape.bounds, solid.triangle_bounds
    surface = solid.surface
    rows = np.arange(len(surface.triangles))
    for axis in range(3):  # at once takes ten times as long
        begins, ends = low[axis] - LEFT_OUT, high[axis] + LEFT_OUT
        kept = (lowest[rows, axis] <= ends) & (highest[rows, axis] >= begins)
        rows = rows[kept]
    planes = outline_of(shape).planes - [0, 0, 0, LEFT_OUT]
    corners = surface.vertices[surface.triangles[rows]]
    # Whole triangles are told by their vertices, which takes a tenth of the time.
    vertices, of = np.unique(surface.triangles[rows], return_inverse=True)
    height, plane = _farthest_above(planes, surface.vertices[vertices])
    of = of.reshape(-1, 3)
    inside = (height[of] <= _ABOVE).all(axis=1)
    rest = np.flatnonzero(~inside)
    for corner in range(3):
        rest = rest[~_is_above(planes[plane[of[rest, corner]]], corners[rest])]
    return np.concatenate([corners[inside], _below_all(planes, corners[rest])])


def _farthest_above(
    planes: FloatArray, points: FloatArray
) -> tuple[FloatArray, IntArray]:
    """Return the height of points (N, 3) above their highest plane, and which it is."""
    height, plane = np.empty(len(points)), np.empty(len(points), dtype=np.int64)
    for some in blocks(len(points), HEIGHTS_AT_ONCE // len(planes)):
        heights = heights_above(planes, points[some])
        plane[some], height[some] = heights.argmax(axis=1), heights.max(axis=1)
    return height, plane


def _is_above(planes: FloatArray, corners: FloatArray) -> BoolArray:
    """Return which triangles (N, 3, 3) are wholly above planes of their own, (N, 4)."""
    heights = np.einsum("tcd,td->tc", corners, planes[:, :3]) + planes[:, 3:]
    return (heights > _ABOVE).all(axis=1)


def _below_all(planes: FloatArray, corners: FloatArray) -> FloatArray:
    """Return what of triangles is below planes (P, 4), in triangles (N, 3, 3).

    Each round cuts every triangle by the plane that it is farthest above.
    """
    found = [corners[:0]]
    while len(corners):
        lowest, heights = _above(planes, corners)
        near = np.flatnonzero(lowest <= _ABOVE)
        left = heights[near].max(axis=1) > _ABOVE
        found.append(corners[near[~left]])
        corners = _below(corners[near[left]], heights[near[left]])
    return np.concatenate(found)


def _above(planes: FloatArray, corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return how high triangles are above planes (P, 4).

    First how high above one plane they are with all corners, (N,). Then the heights of
    their corners above the plane that one of these is farthest above, (N, 3).
    """
    n = len(corners)
    lowest, above = np.empty(n), np.empty((n, 3))
    for some in blocks(n, HEIGHTS_AT_ONCE // (3 * len(planes))):
        heights = corners[some] @ planes[:, :3].T + planes[:, 3]
        lowest[some] = heights.min(axis=1).max(axis=1)
        plane = heights.max(axis=1).argmax(axis=1)
        above[some] = heights[np.arange(len(plane)), :, plane]
    return lowest, above


def _below(corners: FloatArray, heights: FloatArray) -> FloatArray:
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
