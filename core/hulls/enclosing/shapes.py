"""Find the smallest spheres, cylinders and capsules around hulls, or any shape."""

from __future__ import annotations

import numpy as np

from ...geometry.frames import coordinates_along, frame_of, principal_axes
from ...geometry.primitives import CollisionShape, Hull
from ...steps.arrays import FloatArray
from .boxes import DIGITS, box_around, rough_box

# Rounds of the search for the smallest ball; its radius is then exact to a thousandth.
_ROUNDS = 1000
# Rounds while cuts are compared, when a hundredth is enough.
_FEW_ROUNDS = 60


def around(hull: Hull, kind: str) -> CollisionShape:
    """Return the smallest shape of a kind around a hull, or nearly the smallest.

    Parameters
    ----------
    hull : Hull
    kind : str
        'BOX', 'SPHERE', 'CYLINDER' or 'CAPSULE'.

    Returns
    -------
    CollisionShape
        Of cylinders and capsules, the smallest along the axes of the box and the
        principal axes of the vertices.
    """
    if kind == "SPHERE":
        return _sphere(hull, _ROUNDS)
    if kind == "BOX":
        return box_around(hull)
    along = _cylinder if kind == "CYLINDER" else _capsule
    # Only the best is made exactly.
    axes = np.concatenate([box_around(hull).axes, principal_axes(hull.vertices)])
    rough = [along(hull, axis, _FEW_ROUNDS) for axis in axes]
    return along(hull, _smallest(rough).axes[2], _ROUNDS)


def roughly_around(hull: Hull, kind: str) -> CollisionShape:
    """Return a shape of a kind around a hull quickly, a little larger than need be.

    Parameters
    ----------
    hull : Hull
    kind : str
        'BOX', 'SPHERE', 'CYLINDER' or 'CAPSULE'.

    Returns
    -------
    CollisionShape
    """
    if kind == "SPHERE":
        return _sphere(hull, _FEW_ROUNDS)
    box = rough_box(hull)
    if kind == "BOX":
        return box
    along = _cylinder if kind == "CYLINDER" else _capsule
    shapes = [along(hull, axis, _FEW_ROUNDS) for axis in box.axes]
    return _smallest(shapes)


def _smallest(shapes: list[CollisionShape]) -> CollisionShape:
    """Return the first of the smallest shapes."""
    return min(shapes, key=lambda shape: round(shape.volume, DIGITS))


def _sphere(hull: Hull, rounds: int) -> CollisionShape:
    """Return the smallest sphere, found in a number of rounds."""
    center, radius = _smallest_ball(hull.vertices, rounds)
    sizes = np.array([radius, radius, 0.0])
    return CollisionShape("SPHERE", hull, center, np.eye(3), sizes)


def _cylinder(hull: Hull, axis: FloatArray, rounds: int) -> CollisionShape:
    """Return the smallest cylinder along an axis."""
    frame = frame_of(axis)
    local = coordinates_along(frame, hull.vertices)
    center, radius = _smallest_ball(local[:, :2], rounds)
    low, high = local[:, 2].min(), local[:, 2].max()
    middle = coordinates_along(frame.T, np.r_[center, (low + high) / 2])
    sizes = np.array([radius, radius, (high - low) / 2])
    return CollisionShape("CYLINDER", hull, middle, frame, sizes)


def _capsule(hull: Hull, axis: FloatArray, rounds: int) -> CollisionShape:
    """Return the shortest of the capsules with the least radius along an axis."""
    frame = frame_of(axis)
    local = coordinates_along(frame, hull.vertices)
    center, radius = _smallest_ball(local[:, :2], rounds)
    around = np.linalg.norm(local[:, :2] - center, axis=1)
    # Height of the round end above its base, at the distance of each vertex.
    room = np.sqrt(np.maximum(radius**2 - around**2, 0.0))
    low, high = (local[:, 2] + room).min(), (local[:, 2] - room).max()
    middle = coordinates_along(frame.T, np.r_[center, (low + high) / 2])
    sizes = np.array([radius, radius, max(high - low, 0.0) / 2])
    return CollisionShape("CAPSULE", hull, middle, frame, sizes)


def _smallest_ball(points: FloatArray, rounds: int) -> tuple[FloatArray, float]:
    """Return center and radius of nearly the smallest ball around points (N, 2 or 3).

    Bădoiu and Clarkson 2003, "Smaller core-sets for balls": the center moves towards
    the farthest point, by a smaller share of the way in each round.
    """
    center = points.mean(axis=0)
    for step in range(1, rounds + 1):
        away = points - center
        farthest = np.einsum("nd,nd->n", away, away).argmax()
        center = center + away[farthest] / (step + 1)
    return center, float(np.linalg.norm(points - center, axis=1).max())
