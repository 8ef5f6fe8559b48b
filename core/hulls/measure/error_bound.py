"""An upper bound of a collision shape's error, nearly as small as the error itself.

Patches of the surfaces are halved until no point of them can be much farther away than
the farthest point that is known: distances change at most as fast as the place.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ...geometry.primitives import CollisionShape, Hull
from ..outline import fine_outline
from ..solid import Solid
from .estimate import volume_error
from .fragments import distances_to, fragments_of, halved, reach_of
from .surface_within import surface_within
from .uncovered import uncovered

# Errors below this share of the largest one allowed need not be told apart.
_TOLD_APART = 0.5
# The bound exceeds the error by this share at most, where there is time for it.
_TOLERANCE = 0.03
# Longest edge of the first patches; the longest side of the shape is 2.
_COARSE = 0.1
# Longest edge of what the nearest parts of a surface are told by.
_GRAIN = 0.04
# Patches left over in one round; with more, their bounds stand as they are.
_MOST_PATCHES = 60_000
# Fewer patches are halved again before they are looked at, so many times more: a round
# takes as long for one as for some hundreds.
_FEW_PATCHES, _HALVINGS = 400, 2
# Fragments near a patch that its distance is measured to.
_NEIGHBORS = 3

# Bounds of patches (N, 3, 3): what is surely reached, and what is surely not exceeded.
_Bounds = tuple[NDArray[np.float64], NDArray[np.float64]]


def error_bound(
    solid: Solid,
    shape: CollisionShape,
    hull: Hull,
    largest: float,
    limit: float = np.inf,
) -> tuple[float, NDArray[np.float64]]:
    """Return an upper bound of the error of a collision shape.

    The error is the largest of four figures, for a shape S around a piece with the
    convex hull C, in a solid M:

    - R_v of CoACD: 0.3 times the radius of a ball as large as what of S is outside M;
    - the largest distance of a point on S, outside M, from the surface of M within S;
    - the largest depth below the surface of S of a point on the surface of M;
    - the largest distance from S of a point of C: what the shape leaves uncovered.

    Parameters
    ----------
    solid : Solid
    shape : CollisionShape
        In the space of the solid.
    hull : Hull
        Convex hull of the piece that the shape stands for.
    largest : float
        Largest error allowed. Errors below half of it are not told apart.
    limit : float
        Errors above it are not told apart either: the search ends there.

    Returns
    -------
    bound : float
        At least the error, and a few percent more at most where errors are told apart.
        Any figure above `limit` if the error is above it.
    place : (1, 3) or (0, 3) float
        A point of the shape that is far from the surface, if there is one.
    """
    enough, bound = largest * _TOLD_APART, uncovered(shape, hull)
    targets = surface_within(solid, shape)
    least = max(enough, bound)
    depths = _largest(targets, lambda c, _: _depths(shape, c), least, limit)[0]
    bound, place = max(bound, depths), np.zeros((0, 3))
    if bound <= limit:
        surface = targets if len(targets) else solid.corners
        away, place = _farthest(solid, shape, surface, max(enough, bound), limit)
        bound = max(bound, away)
    if max(bound, enough) < volume_error(shape.volume) and bound <= limit:
        bound = max(bound, volume_error(solid.inside.volume_outside(shape)))
    return bound, place


def _farthest(
    solid: Solid,
    shape: CollisionShape,
    surface: NDArray[np.float64],
    enough: float,
    limit: float,
) -> tuple[float, NDArray[np.float64]]:
    """Return a bound of the distance of points on a shape from a surface, and where.

    The surface is triangles (T, 3, 3).
    """
    small, origins = fragments_of(surface, _GRAIN)
    targets = surface[origins]
    # Building a balanced tree takes twice as long, and questions are few.
    tree = cKDTree(small.mean(axis=1), balanced_tree=False, compact_nodes=False)
    outline, gap = fine_outline(shape)
    outline = fragments_of(outline, _COARSE)[0]

    def away(corners: NDArray[np.float64], level: float) -> _Bounds:
        return _distances(solid, targets, tree, corners, level)

    distance, place = _largest(outline, away, max(enough - gap, gap), limit - gap)
    return distance + gap, place


def _largest(
    corners: NDArray[np.float64],
    bounds_of: Callable[[NDArray[np.float64], float], _Bounds],
    enough: float,
    limit: float,
) -> tuple[float, NDArray[np.float64]]:
    """Return an upper bound of a function's largest value on patches (N, 3, 3).

    The second value is where it is reached: (1, 3), or (0, 3) if it is below `enough`.
    The search ends with the first value above `limit`.
    """
    reached, bound, level = 0.0, 0.0, enough
    place = np.zeros((0, 3))
    while len(corners):
        low, high = bounds_of(corners, level)
        if low.max() > max(reached, enough):
            place = corners[[low.argmax()]].mean(axis=1)
        reached = max(reached, float(low.max()))
        if reached > limit:
            break
        level = max(min(reached * (1 + _TOLERANCE), limit), enough)
        left = high > level
        bound = max(bound, float(high[~left].max(initial=0.0)))
        if left.sum() > _MOST_PATCHES:
            return max(bound, float(high.max())), place
        corners = halved(corners[left])
        for _ in range(_HALVINGS):
            if len(corners) < _FEW_PATCHES:
                corners = halved(corners)
    return max(bound, reached), place


def _depths(shape: CollisionShape, corners: NDArray[np.float64]) -> _Bounds:
    """Return bounds of the depth of patches below the surface of a shape."""
    centers, radii = reach_of(corners)
    depths = -shape.heights(centers)
    if shape.kind != "HULL":
        return depths, depths + radii
    return depths, -shape.hull.heights_of_patches(corners)


def _distances(
    solid: Solid,
    targets: NDArray[np.float64],
    tree: cKDTree,
    corners: NDArray[np.float64],
    level: float,
) -> _Bounds:
    """Return bounds of the distance of patches outside a solid from targets."""
    centers, radii = reach_of(corners)
    places = np.concatenate([corners, centers[:, None]], axis=1)
    rows = tree.query(centers, min(_NEIGHBORS, len(targets)))[1]
    # The distance from a triangle is convex: it is largest at a corner of the patch.
    away = _from_each(places, targets[rows.reshape(len(centers), -1)])
    nearest = away[:, 3].min(axis=1)
    high = np.minimum(away.max(axis=1).min(axis=1), nearest + radii)
    low, hard = np.zeros(len(centers)), np.flatnonzero(high > level)
    inside, unbroken = solid.inside.holds_patches(centers[hard], radii[hard])
    low[hard[~inside]] = nearest[hard[~inside]]
    # A way from inside to a point outside crosses the surface, if through no hole.
    whole = hard[inside & unbroken]
    high[whole] = np.minimum(high[whole], radii[whole])
    return low, high


def _from_each(
    places: NDArray[np.float64], targets: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return distances of places (N, P, 3) from triangles (N, K, 3, 3), (N, P, K)."""
    n, p, k = *places.shape[:2], targets.shape[1]
    away = distances_to(
        np.repeat(places.reshape(-1, 3), k, axis=0),
        np.repeat(targets, p, axis=0).reshape(-1, 3, 3),
    )
    return away.reshape(n, p, k)
