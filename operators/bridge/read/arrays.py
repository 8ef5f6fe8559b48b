"""Turn the arguments of scripts into shapes: arrays, lists, and mesh objects."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....core.errors import DecompositionError
from ....core.geometry.array_checks import (
    check_indices,
    described,
    real_numbers,
    rows_of_three,
)
from ....core.geometry.cutting.triangulation import triangulate
from ....core.geometry.mesh import TriangleMesh
from ....core.geometry.point_cloud import PointCloud
from ....core.steps.arrays import FloatArray, IntArray

_OWN = (TriangleMesh, PointCloud)
_SHAPES = (
    "vertices with faces, points, a TriangleMesh, a PointCloud, a Blender object, or"
    " anything with vertices and faces"
)


def shape_of(shape: object, faces: object) -> TriangleMesh | PointCloud:
    """Return the shape that a script passed, as a mesh or a point cloud.

    Parameters
    ----------
    shape : object
        Vertices (V, 3), a TriangleMesh, a PointCloud, a Blender object, or any object
        with attributes `vertices` and `faces` or `triangles`, such as a
        `trimesh.Trimesh`; one that has `vertices` alone is a point cloud.
    faces : sequence of sequences of int, or None
        Vertex rows of each polygon. Vertices without faces are points.

    Raises
    ------
    TypeError
        If an argument is of another type.
    DecompositionError
        If the shape has no surface that can be decomposed.
    """
    is_object = _is_blender_object(shape)
    named = hasattr(shape, "vertices")
    if faces is not None and (is_object or named or isinstance(shape, _OWN)):
        name = type(shape).__name__
        raise TypeError(f"The {name} is a shape already; leave out `faces`.")
    if isinstance(shape, _OWN):
        return shape
    if is_object:
        from .shape import read_shape

        return read_shape(shape)
    if named:
        faces = getattr(shape, "faces", getattr(shape, "triangles", None))
        shape = shape.vertices  # type: ignore[attr-defined]
    vertices = _vertices_of(shape)
    if faces is None:
        return PointCloud(vertices)
    return TriangleMesh(vertices, *_triangles_of(vertices, faces))


def mesh_of(shape: object, faces: object) -> TriangleMesh:
    """Return the mesh that a script passed.

    Parameters
    ----------
    shape : object
        Vertices (V, 3), a TriangleMesh, a Blender object, or any object with
        attributes `vertices` and `faces`.
    faces : sequence of sequences of int, or None
        Vertex rows of each polygon.

    Raises
    ------
    TypeError
        If an argument is of another type.
    DecompositionError
        If the shape has no faces, or no surface that can be decomposed.
    """
    mesh = shape_of(shape, faces)
    if isinstance(mesh, PointCloud):
        raise DecompositionError(
            "Hulls need faces, and these are points; pass `faces`, or a mesh."
        )
    return mesh


def stretch(shape: object) -> FloatArray:
    """Return the matrix that coordinates in results of a shape are multiplied by.

    Results of Blender objects have the proportions that these have in the scene, at the
    volume of their mesh. Multiply by the inverse to get to the object's own space.

    Parameters
    ----------
    shape : object
        As for `decompose`.

    Returns
    -------
    (3, 3) float
        Symmetric, of determinant 1. It is diagonal for an object that no parent shears.
        It is the identity where the scale is uniform, and for all but objects.

    Raises
    ------
    DecompositionError
        If the scale of an object is zero, or its place is not finite.
    """
    if not _is_blender_object(shape):
        return np.eye(3)
    from .shape import stretch as stretch_of_object

    return stretch_of_object(shape)


def scene_unit_of(shape: object) -> float:
    """Return the length of 1 in the coordinates of a shape that a script passed.

    Parameters
    ----------
    shape : object
        As for `mesh_of`.

    Returns
    -------
    float
        In units of the scene for Blender objects, whose scale counts; 1 for others.
    """
    if not _is_blender_object(shape):
        return 1.0
    from .shape import scene_unit

    return scene_unit(shape)


def _is_blender_object(shape: object) -> bool:
    """Return whether a shape is a Blender object; TypeError for other Blender data."""
    kind = getattr(type(shape), "bl_rna", None)  # objects may have been removed
    if kind is None:
        return False
    if kind.identifier != "Object":
        raise TypeError(
            f"A shape cannot be a {kind.identifier} of Blender; pass the object that"
            " has it."
        )
    try:
        _check_readable(shape)
    except ReferenceError as error:
        raise DecompositionError(
            "The object has been removed from Blender; pass one that is there."
        ) from error
    return True


def _check_readable(obj: Any) -> None:
    """Raise if a Blender object has neither faces nor points."""
    from ..refusals import CONVERTIBLE, WORKED_ON

    if obj.type not in CONVERTIBLE | WORKED_ON:
        raise DecompositionError(
            f"{obj.name} is not a mesh; pass a mesh or a point cloud."
        )


def _vertices_of(shape: object) -> FloatArray:
    """Return the vertices (V, 3) that a script passed."""
    vertices = real_numbers(shape)
    if vertices is None:
        raise TypeError(f"A shape must be {_SHAPES}, not {described(shape)}.")
    return rows_of_three(vertices, "Vertices").astype(np.float64)


def _triangles_of(vertices: FloatArray, faces: object) -> tuple[IntArray, IntArray]:
    """Return the triangles (T, 3) of faces, and the face (T,) of each."""
    array = real_numbers(faces)
    if array is not None and array.ndim == 2:
        faces = array  # it was anything that NumPy can read
        if array.shape[1] == 3:
            return _indices(array), np.arange(len(array))
    if not isinstance(faces, Sequence | np.ndarray):
        raise TypeError(
            f"`faces` must be rows of vertex numbers, (F, 3) or lists of any length,"
            f" not {described(faces)}."
        )
    if array is not None and array.ndim == 2 and array.shape[1] > 3:
        polygons = list(_indices(array))
    else:
        polygons = [_polygon(face, row) for row, face in enumerate(faces)]
    if polygons:
        check_indices(np.concatenate(polygons), len(vertices))
    return triangulate(vertices, polygons)


def _polygon(face: object, row: int) -> IntArray:
    """Return the vertex numbers of one face, (N,), N at least 3."""
    corners = real_numbers(face)
    if corners is None or corners.ndim != 1:
        raise TypeError(
            f"Face {row} must be a list of vertex numbers, not {described(face)}."
        )
    if len(corners) < 3:
        raise DecompositionError(
            f"Face {row} has {len(corners)} corners; leave out faces of fewer than 3."
        )
    return _indices(corners)


def _indices(array: NDArray[Any]) -> IntArray:
    """Return vertex numbers as integers; raise if they are not whole."""
    if array.dtype.kind == "f" and array.size:
        raise TypeError(
            "`faces` must be whole numbers below 2**63: rows of the vertices."
        )
    return array.astype(np.int64)  # numbers beyond the type become negative
