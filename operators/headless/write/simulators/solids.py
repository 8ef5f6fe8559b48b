"""Boxes, spheres, cylinders and capsules among hulls, in the frame of a body."""

from __future__ import annotations

import json
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix

from ....bridge.stored.names import HULL_TAG
from ..placed_meshes import FloatArray

# Axes that differ by less, in length or from a right angle, are those of a solid.
_SAME = 1e-4


@dataclass(frozen=True, eq=False)
class Solid:
    """A primitive.

    Attributes
    ----------
    kind : str
        'BOX', 'SPHERE', 'CYLINDER' or 'CAPSULE'.
    center : (3,) float
    rotation : (3, 3) float
        Its columns are the axes of the solid; cylinders and capsules lie along the
        last one.
    sizes : (3,) float
        Box: half of each side. Others: radius, radius, half of the height; that of a
        capsule excludes its round ends.
    """

    kind: str
    center: FloatArray
    rotation: FloatArray
    sizes: FloatArray


def solid_of(hull: bpy.types.Object, matrix: FloatArray) -> Solid | None:
    """Return the primitive that a hull stands for, moved by a matrix.

    Parameters
    ----------
    hull : Object
        Its figures have the kind of the shape and its pose.
    matrix : (4, 4) float
        From the space of the hull's mesh to where the solid is wanted.

    Returns
    -------
    Solid or None
        None for a convex hull, and for a primitive that the matrix distorts: a scale
        that differs by axis turns spheres into ellipsoids. Its mesh has that shape.
    """
    figures = json.loads(hull.get(HULL_TAG, "{}"))
    if figures.get("kind", "HULL") == "HULL" or "axes" not in figures:
        return None
    kind, sizes = figures["kind"], np.array(figures["sizes"], dtype=np.float64)
    axes = matrix[:3, :3] @ np.array(figures["axes"], dtype=np.float64).T
    lengths = np.linalg.norm(axes, axis=0)
    if not lengths.all():
        return None
    rotation = axes / lengths
    if np.abs(rotation.T @ rotation - np.eye(3)).max() > _SAME:
        return None
    if kind != "BOX" and np.ptp(lengths) > _SAME * lengths.max():
        return None
    if np.linalg.det(rotation) < 0:  # solids are their own mirror images
        rotation[:, 0] *= -1
    if kind == "CAPSULE" and sizes[2] <= _SAME * sizes[0]:
        kind = "SPHERE"  # MuJoCo refuses a capsule without length
    center = matrix[:3, :3] @ np.array(figures["center"]) + matrix[:3, 3]
    return Solid(kind, center, rotation, sizes * lengths)


def quaternion_of(rotation: FloatArray) -> FloatArray:
    """Return a rotation matrix (3, 3) as a quaternion w, x, y, z."""
    return np.array(Matrix(rotation.tolist()).to_quaternion())


def angles_of(rotation: FloatArray) -> FloatArray:
    """Return a rotation matrix (3, 3) as URDF's roll, pitch and yaw, in radians."""
    return np.array(Matrix(rotation.tolist()).to_euler("XYZ"))
