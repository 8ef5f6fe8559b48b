"""Where a collision shape of an object is, and how large it is there.

The pose of a primitive is noted on its hull in the space of the hull. Reports,
simulators and others bring it to the space that they need by a matrix.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix

from ....core.geometry.frames import moved
from ....core.geometry.primitives import CollisionShape
from ....core.steps.arrays import FloatArray
from ..read.shape import stretch
from ..read.stretching import unstretched
from ..stored.noted_hulls import figures_on

# Axes that differ by less, in length or from a right angle, are those of a solid.
_SAME = 1e-4


@dataclass(frozen=True, eq=False)
class Primitive:
    """A box, sphere, cylinder or capsule in some space.

    Attributes
    ----------
    kind : str
        'BOX', 'SPHERE', 'CYLINDER' or 'CAPSULE'.
    center : (3,) float
    rotation : (3, 3) float
        Its columns are the axes of the primitive; cylinders and capsules lie along the
        last one.
    sizes : (3,) float
        Box: half of each side. Others: radius, radius, half of the height; that of a
        capsule excludes its round ends.
    """

    kind: str
    center: FloatArray
    rotation: FloatArray
    sizes: FloatArray


def pose_of(shape: CollisionShape, scale: FloatArray) -> dict[str, Any]:
    """Return kind, center, axes and sizes of a primitive, in object space.

    Axes are rows. Object space is not scaled yet: the `scale`, (3, 3), is its stretch.
    Where that is not the identity, the axes have other lengths than 1 there, and may
    be sheared. Sizes are multiples of them.
    """
    if shape.kind == "HULL":
        return {"kind": shape.kind}
    return {
        "kind": shape.kind,
        "center": unstretched(shape.center, scale).tolist(),
        "axes": unstretched(shape.axes, scale).tolist(),
        "sizes": shape.sizes.tolist(),
    }


def moved_pose(pose: dict[str, Any], matrix: FloatArray) -> dict[str, Any]:
    """Return a pose, moved by a matrix, which may distort its primitive."""
    if "axes" not in pose:
        return pose
    center = moved(np.array(pose["center"]), matrix)
    axes = pose["axes"] @ matrix[:3, :3].T
    return pose | {"center": center.tolist(), "axes": axes.tolist()}


def _undistorted(pose: dict[str, Any], matrix: FloatArray) -> Primitive | None:
    """Return the primitive of a pose, moved by a matrix.

    None for a convex hull, and if the matrix distorts the primitive.
    """
    if "axes" not in pose:
        return None
    pose = moved_pose(pose, matrix)
    kind, axes = pose["kind"], np.array(pose["axes"]).T
    lengths = np.linalg.norm(axes, axis=0)
    if not lengths.all():
        return None
    rotation = axes / lengths
    if np.abs(rotation.T @ rotation - np.eye(3)).max() > _SAME:
        return None
    if kind != "BOX" and np.ptp(lengths) > _SAME * lengths.max():
        return None
    if np.linalg.det(rotation) < 0:  # primitives are their own mirror images
        rotation[:, 0] *= -1
    return Primitive(kind, np.array(pose["center"]), rotation, pose["sizes"] * lengths)


def primitive_of(hull: bpy.types.Object, matrix: FloatArray) -> Primitive | None:
    """Return the primitive that a hull stands for, moved by a matrix.

    Parameters
    ----------
    hull : Object
        Its figures have the kind of the shape and its pose.
    matrix : (4, 4) float
        From the space of the hull's mesh to where the primitive is wanted.

    Returns
    -------
    Primitive or None
        None for a convex hull, and for a primitive that the matrix distorts: a scale
        that differs by axis turns spheres into ellipsoids. Its mesh has that shape.
    """
    found = _undistorted(figures_on(hull), matrix)
    if found and found.kind == "CAPSULE" and found.sizes[2] <= _SAME * found.sizes[0]:
        return replace(found, kind="SPHERE")  # MuJoCo refuses a capsule without length
    return found


def pose_in_scene(shape: CollisionShape, obj: bpy.types.Object) -> dict[str, Any]:
    """Return pose, size and volume of a shape, in the scene.

    The shape is in the space that `read_shape` reads its object in.

    Returns
    -------
    dict
        `position` is the center. `rotation` is a unit quaternion (w, x, y, z); it
        turns the axes of the scene into those of the shape. `size` has `extents` along
        the axes, or `radius` and `length`; the length of a capsule excludes its ends.
        A hull is not turned: its extents are those of its bounding box.
    """
    to_scene, scale = np.array(obj.matrix_world, dtype=np.float64), stretch(obj)
    turn = unstretched(to_scene[:3, :3], scale)  # it keeps angles, and may mirror
    volume = float(shape.volume) * abs(float(np.linalg.det(turn)))
    found = _undistorted(pose_of(shape, scale), to_scene)
    if found is not None:
        return {
            "position": found.center.tolist(),
            "rotation": quaternion_of(found.rotation).tolist(),
            "size": _size(found),
            "volume": volume,
        }
    vertices = shape.hull.vertices @ turn.T + to_scene[:3, 3]
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return {
        "position": ((low + high) / 2).tolist(),
        "rotation": [1.0, 0.0, 0.0, 0.0],
        "size": {"extents": (high - low).tolist()},
        "volume": volume,
    }


def _size(primitive: Primitive) -> dict[str, Any]:
    """Return the size of a primitive by name."""
    radius, length = float(primitive.sizes[0]), float(2 * primitive.sizes[2])
    if primitive.kind == "BOX":
        return {"extents": (2 * primitive.sizes).tolist()}
    if primitive.kind == "SPHERE":
        return {"radius": radius}
    return {"radius": radius, "length": length}


def quaternion_of(rotation: FloatArray) -> FloatArray:
    """Return a rotation matrix (3, 3) as a unit quaternion w, x, y, z."""
    return np.array(Matrix(rotation.tolist()).to_quaternion().normalized())


def angles_of(rotation: FloatArray) -> FloatArray:
    """Return a rotation matrix (3, 3) as URDF's roll, pitch and yaw, in radians."""
    return np.array(Matrix(rotation.tolist()).to_euler("XYZ"))
