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
from ..convex_hull import THIN
from ..outline import fine_outline
from ..solid import Solid
from .estimate import volume_error
from .fragments import distances_to, fragments_of, halved
from .uncovered import uncovered

# Errors below this share of the largest one allowed need not be told apart.
_TOLD_APART = 0.5
# The bound exceeds the error by this share at most, where there is time for it.
_TOLERANCE = 0.03
# Longest edge of the first patches; the longest side of the shape is 2.
_COARSE = 0.2
# Patches left over in one round; with more, their bounds stand as they are.
_MOST_PATCHES = 60_000
# Fragments near a patch that its distance is measured to.
_NEIGHBORS = 3
# Share by which distances may be too large where a rough one may do.
_ROUGHLY = 0.5
# The surface is within a shape that it is outside of by less: hulls are simplified.
_WITHIN = THIN / 10

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
    near, targets = _surface_within(solid, shape)
    least = max(enough, bound)
    depths = _largest(near, lambda c, _: _depths(shape, c), least, limit)[0]
    bound, place = max(bound, depths), np.zeros((0, 3))
    if bound <= limit:
        surface = (near, targets) if len(near) else (solid.fragments,) * 2
        away, place = _farthest(solid, shape, surface, max(enough, bound), limit)
        bound = max(bound, away)
    if max(bound, enough) < volume_error(shape.volume) and bound <= limit:
        bound = max(bound, volume_error(solid.inside.volume_outside(shape)))
    return bound, place


def _farthest(
    solid: Solid,
    shape: CollisionShape,
    surface: _Bounds,
    enough: float,
    limit: float,
) -> tuple[float, NDArray[np.float64]]:
    """Return a bound of the distance of points on a shape from a surface, and where.

    The surface is as `_surface_within` returns it.
    """
    small, targets = surface
    tree = cKDTree(small.mean(axis=1))
    outline, gap = fine_outline(shape)

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
    corners = fragments_of(corners, _COARSE)[0]
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
    return max(bound, reached), place


def _reach(corners: NDArray[np.float64]) -> _Bounds:
    """Return the centers of triangles, and their largest distances from corners."""
    centers = corners.mean(axis=1)
    arms = corners - centers[:, None]
    return centers, np.sqrt(np.einsum("tcd,tcd->tc", arms, arms).max(axis=1))


def _depths(shape: CollisionShape, corners: NDArray[np.float64]) -> _Bounds:
    """Return bounds of the depth of patches below the surface of a shape."""
    centers, radii = _reach(corners)
    depths = -shape.heights(centers)
    return depths, depths + radii


def _distances(
    solid: Solid,
    targets: NDArray[np.float64],
    tree: cKDTree,
    corners: NDArray[np.float64],
    level: float,
) -> _Bounds:
    """Return bounds of the distance of patches outside a solid from targets."""
    centers, radii = _reach(corners)
    low, high = np.zeros(len(centers)), np.full(len(centers), np.inf)
    inside, unbroken = solid.inside.holds_patches(corners, centers, radii)
    # A way from inside to a point outside crosses the surface, if through no hole.
    whole = np.flatnonzero(inside & unbroken)
    most = float(radii.max()) + solid.reach
    free = solid.tree.query(centers[whole], distance_upper_bound=most)[0]
    free = np.minimum(free, most) - solid.reach
    high[whole] = np.maximum(radii[whole] - np.maximum(free, 0.0), 0.0)
    hard = np.flatnonzero(high > level)
    rows = tree.query(centers[hard], eps=_ROUGHLY)[1]
    rough = distances_to(centers[hard], targets[rows]) + radii[hard]
    high[hard] = np.minimum(high[hard], rough)
    hard = hard[high[hard] > level]
    if len(hard) == 0:
        return low, high
    # The distance from a triangle is convex: it is largest at a corner of the patch.
    near = tree.query(centers[hard], min(_NEIGHBORS, len(targets)))[1]
    near = near.reshape(len(hard), -1)
    n_near = near.shape[1]
    places = np.concatenate([corners[hard], centers[hard, None]], axis=1)
    away = distances_to(
        np.repeat(places.reshape(-1, 3), n_near, axis=0),
        targets[np.repeat(near, 4, axis=0).ravel()],
    ).reshape(-1, 4, n_near)
    high[hard] = np.minimum(high[hard], away.max(axis=1).min(axis=1))
    low[hard] = np.where(inside[hard], 0.0, away[:, 3].min(axis=1))
    return low, high


def _surface_within(solid: Solid, shape: CollisionShape) -> _Bounds:
    """Return triangles of the surface of a solid that are within a shape, (N, 3, 3).

    They are small. The second array has triangles within the shape that contain them:
    the whole triangles of the mesh, where possible.
    """
    low, high = shape.bounds
    slack = _WITHIN + solid.grain
    rows = ((low - slack <= solid.centers) & (solid.centers <= high + slack)).all(
        axis=1
    )
    if not rows.any():
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
    # Others may reach into the shape: of their pieces, take the corners that do.
    pieces = fragments_of(near[cut], solid.grain / 4)[0]
    held = _held(shape, pieces)
    pieces, held = pieces[held.any(axis=1)], held[held.any(axis=1)]
    order = np.argsort(~held, axis=1, kind="stable")
    chosen = np.where(np.take_along_axis(held, order, axis=1), order, order[:, :1])
    pieces = np.take_along_axis(pieces, chosen[..., None], axis=1)
    return np.concatenate([near[whole], pieces]), np.concatenate([targets, pieces])


def _held(shape: CollisionShape, corners: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which corners of triangles are within a shape, (N, 3)."""
    heights = shape.heights(corners.reshape(-1, 3)).reshape(-1, 3)
    held: NDArray[np.bool_] = heights <= _WITHIN
    return held
