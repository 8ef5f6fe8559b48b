"""The meshes of objects in world space, or in another frame, as arrays."""

from __future__ import annotations

import bpy
import numpy as np

from ....core.geometry.frames import moved
from ....core.steps.arrays import FloatArray, IntArray
from ...bridge.mesh.known import triangles_of

# Digits that keep numbers of single and of double precision as they are.
SINGLE, DOUBLE = 9, 17


def matrix_of(obj: bpy.types.Object) -> FloatArray:
    """Return the matrix from an object's space to the world, (4, 4)."""
    return np.array(obj.matrix_world, dtype=np.float64)


def placed(
    obj: bpy.types.Object, matrix: FloatArray
) -> tuple[FloatArray, IntArray, IntArray]:
    """Return the mesh of an object, moved by a matrix.

    Double precision: a small object far away keeps its digits.

    Parameters
    ----------
    obj : Object
        A mesh, read without its modifiers.
    matrix : (4, 4) float
        From the object's space to where the mesh is wanted. Triangles of mirrored
        objects are turned around, so that they still face outwards.

    Returns
    -------
    vertices : (V, 3) float
    triangles : (T, 3) int
    faces : (T,) int
        Polygon of each triangle.
    """
    vertices, triangles, faces = triangles_of(obj.data)
    if np.linalg.det(matrix[:3, :3]) < 0:
        triangles = triangles[:, ::-1]
    return moved(vertices, matrix), triangles, faces


def turned_up(vertices: FloatArray, up: str) -> FloatArray:
    """Return vertices (V, 3) for a file in which `up` ('Y' or 'Z') points up."""
    if up == "Z":
        return vertices
    x, y, z = vertices.T
    return np.stack([x, z, -y], axis=1)


def digits_of(numbers: FloatArray, n_digits: int = SINGLE) -> str:
    """Return numbers as text; no digit of single precision is lost.

    Digits count from the first one that is not zero, so models of any size keep theirs.
    """
    # Adding 0 turns -0 into 0.
    return " ".join(f"{number + 0.0:.{n_digits}g}" for number in numbers)
