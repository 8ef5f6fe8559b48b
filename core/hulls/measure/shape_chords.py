"""Where parallel lines enter and leave collision shapes."""

from __future__ import annotations

import numpy as np

from ...geometry.frames import heights_above
from ...geometry.primitives import CollisionShape
from ...steps.arrays import FloatArray


def chord_in(
    shape: CollisionShape, origins: FloatArray, direction: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return where parallel lines enter and leave a collision shape.

    Parameters
    ----------
    shape : CollisionShape
    origins : (L, 3) float
        A point of each line.
    direction : (3,) float
        Unit vector.

    Returns
    -------
    enter, leave : (L,) float
        Distances from the points along the direction. Lines that miss the shape leave
        it before they enter.
    """
    if shape.kind == "HULL":
        planes = shape.hull.planes
        return _between(heights_above(planes, origins), planes[:, :3] @ direction)
    local, along = (origins - shape.center) @ shape.axes.T, shape.axes @ direction
    radius, _, half = shape.sizes
    if shape.kind == "BOX":
        return _between(
            np.hstack([local, -local]) - np.tile(shape.sizes, 2), np.r_[along, -along]
        )
    if shape.kind == "SPHERE":
        return _in_ball(local, along, radius)
    ends = _between(
        np.stack([local[:, 2], -local[:, 2]], 1) - half, np.r_[along[2], -along[2]]
    )
    round_ = _in_ball(local[:, :2], along[:2], radius)
    middle = np.maximum(ends[0], round_[0]), np.minimum(ends[1], round_[1])
    if shape.kind == "CYLINDER":
        return middle
    tip = np.array([0.0, 0.0, half])
    chords = [
        middle,
        _in_ball(local - tip, along, radius),
        _in_ball(local + tip, along, radius),
    ]
    enter, leave = np.stack([c[0] for c in chords]), np.stack([c[1] for c in chords])
    met = leave > enter
    return np.where(met, enter, np.inf).min(axis=0), np.where(met, leave, -np.inf).max(
        axis=0
    )


def _between(heights: FloatArray, slopes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return where lines are below planes: at heights (L, P), rising by slopes."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = -heights / slopes
    ends = np.where(slopes == 0, np.where(heights <= 0, np.inf, -np.inf), ends)
    enter = ends[:, slopes < 0].max(axis=1, initial=-np.inf)
    return enter, ends[:, slopes >= 0].min(axis=1, initial=np.inf)


def _in_ball(
    places: FloatArray, along: FloatArray, radius: float
) -> tuple[FloatArray, FloatArray]:
    """Return where lines are within a radius of the origin, in 2D or 3D."""
    square = max(float(along @ along), 1e-30)
    middle = -(places @ along) / square
    away = places + middle[:, None] * along
    room = (radius**2 - np.einsum("ld,ld->l", away, away)) / square
    half = np.sqrt(np.maximum(room, 0.0))
    return np.where(room > 0, middle - half, np.inf), np.where(
        room > 0, middle + half, -np.inf
    )
