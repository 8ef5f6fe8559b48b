"""Where a collision shape of an object is in the scene, and how large it is there."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ....core.geometry.primitives import CollisionShape
from ..read.shape import stretch


def placed(shape: CollisionShape, obj: bpy.types.Object) -> dict[str, Any]:
    """Return pose, size and volume of a shape, in the scene.

    Parameters
    ----------
    shape : CollisionShape
        In the space that `read_shape` reads its object in.
    obj : bpy.types.Object

    Returns
    -------
    dict
        `position` is the center. `rotation` is a unit quaternion (w, x, y, z); it
        turns the axes of the scene into those of the shape. `size` has `extents` along
        the axes, or `radius` and `length`; the length of a capsule excludes its ends.
        A hull is not turned: its extents are those of its bounding box.
    """
    to_scene = np.array(obj.matrix_world, dtype=np.float64)
    turn = to_scene[:3, :3] / stretch(obj)  # it keeps angles, and may mirror
    scale = float(np.cbrt(abs(np.linalg.det(turn))))
    volume = float(shape.volume) * scale**3
    if shape.kind == "HULL":
        vertices = shape.hull.vertices @ turn.T + to_scene[:3, 3]
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        return {
            "position": ((low + high) / 2).tolist(),
            "rotation": [1.0, 0.0, 0.0, 0.0],
            "size": {"extents": (high - low).tolist()},
            "volume": volume,
        }
    axes = turn @ shape.axes.T / scale  # columns
    if np.linalg.det(axes) < 0:  # shapes are symmetric: one axis may point back
        axes[:, 0] *= -1
    return {
        "position": (turn @ shape.center + to_scene[:3, 3]).tolist(),
        "rotation": list(Matrix(axes.tolist()).to_quaternion().normalized()),
        "size": _size(shape.kind, shape.sizes * scale),
        "volume": volume,
    }


def _size(kind: str, sizes: NDArray[np.float64]) -> dict[str, Any]:
    """Return the size of a primitive by name."""
    radius, length = float(sizes[0]), float(2 * sizes[2])
    if kind == "BOX":
        return {"extents": (2 * sizes).tolist()}
    if kind == "SPHERE":
        return {"radius": radius}
    return {"radius": radius, "length": length}
