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
# Number of times that the part of an edge is halved in which it leaves a shape.
_BISECTIONS = 5


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

    Pieces with edges no longer than `longest` are clipped, if a corner is within.
    """
    found = [corners[:0]]
    while len(corners):
        held = _held(shape, corners)
        done = edge_lengths(corners).max(axis=1) <= longest
        whole = held.all(axis=1)
        clipped = held.any(axis=1) & done & ~whole
        found += [corners[whole], _clipped(shape, corners[clipped], held[clipped])]
        centers, radii = reach_of(corners)
        beyond = shape.heights(centers) > _WITHIN + radii
        corners = halved(corners[~done & ~whole & ~beyond])
    return np.concatenate(found)


def _clipped(
    shape: CollisionShape, corners: NDArray[np.float64], held: NDArray[np.bool_]
) -> NDArray[np.float64]:
    """Return triangles within a shape, of triangles with one or two corners there.

    They have the corners within, and points where edges leave the shape.
    """
    # The corner alone on its side comes first.
    lone = held.sum(axis=1) == 1
    first = np.where(lone[:, None], held, ~held).argmax(axis=1)
    turn = (first[:, None] + np.arange(3)) % 3
    corners = np.take_along_axis(corners, turn[..., None], axis=1)
    alone, others = corners[:, :1].repeat(2, axis=1), corners[:, 1:]
    within = np.where(lone[:, None, None], alone, others)
    way = np.where(lone[:, None, None], others, alone) - within
    share, step = np.zeros(way.shape[:2]), 1.0
    for _ in range(_BISECTIONS):
        step /= 2
        places = within + (share + step)[..., None] * way
        share += step * (shape.heights(places.reshape(-1, 3)).reshape(-1, 2) <= _WITHIN)
    ends = within + share[..., None] * way
    rest = ~lone
    return np.concatenate(
        [
            np.concatenate([within[:, :1], ends], axis=1)[lone],
            np.concatenate([others, ends[:, :1]], axis=1)[rest],
            np.concatenate([others[:, 1:], ends], axis=1)[rest],
        ]
    )


def _held(shape: CollisionShape, corners: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which corners of triangles are within a shape, (N, 3)."""
    heights = shape.heights(corners.reshape(-1, 3)).reshape(-1, 3)
    held: NDArray[np.bool_] = heights <= _WITHIN
    return held
