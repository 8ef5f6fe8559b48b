"""Turn the arguments of scripts into shapes: arrays, lists, and mesh objects."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....core.errors import DecompositionError
from ....core.geometry.mesh import TriangleMesh
from ....core.geometry.point_cloud import PointCloud
from ....core.geometry.triangulation import triangulate

_OWN = (TriangleMesh, PointCloud)
_SHAPES = (
    "vertices with faces, points, a TriangleMesh, a PointCloud, a Blender object, or"
    " anything with vertices and faces"
)


def shape_of(shape: object, faces: object = None) -> TriangleMesh | PointCloud:
    """Return the shape that a script passed, as a mesh or a point cloud.

    Parameters
    ----------
    shape : object
        Vertices (V, 3), a TriangleMesh, a PointCloud, a Blender object, or any object
        with attributes `vertices` and `faces`, such as a `trimesh.Trimesh`.
    faces : sequence of sequences of int, optional
        Vertex rows of each polygon. Vertices without faces are points.

    Returns
    -------
    TriangleMesh or PointCloud

    Raises
    ------
    TypeError
        If an argument is of another type.
    DecompositionError
        If the shape has no surface that can be decomposed.
    """
    is_object = _is_blender_object(shape)
    named = hasattr(shape, "vertices") and hasattr(shape, "faces")
    if faces is not None and (is_object or named or isinstance(shape, _OWN)):
        name = type(shape).__name__
        raise TypeError(f"A {name} is a shape already; leave out `faces`.")
    if isinstance(shape, _OWN):
        return shape
    if is_object:
        from .shape import read_shape

        return read_shape(shape)
    if named:
        shape, faces = shape.vertices, shape.faces  # type: ignore[attr-defined]
    vertices = _vertices_of(shape)
    if faces is None:
        return PointCloud(vertices)
    return TriangleMesh(vertices, *_triangles_of(vertices, faces))


def mesh_of(shape: object, faces: object = None) -> TriangleMesh:
    """Return the mesh that a script passed.

    Parameters
    ----------
    shape : object
        Vertices (V, 3), a TriangleMesh, a Blender object, or any object with
        attributes `vertices` and `faces`.
    faces : sequence of sequences of int, optional
        Vertex rows of each polygon.

    Returns
    -------
    TriangleMesh

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


def labels_of(
    labels: object, mesh: TriangleMesh, needed: bool
) -> NDArray[np.int64] | None:
    """Return the labels that a script passed, after checking them.

    Parameters
    ----------
    labels : object
        Part of each polygon, or None.
    mesh : TriangleMesh
        The mesh whose polygons they label.
    needed : bool
        Whether None is an error.

    Returns
    -------
    (P,) int or None

    Raises
    ------
    TypeError
        If labels are not whole numbers.
    DecompositionError
        If labels do not fit the mesh, or are needed and missing.
    """
    if labels is None:
        if needed:
            raise DecompositionError(
                "Pieces = PARTS needs the part of each face; pass `labels`, as"
                " `decompose` finds them."
            )
        return None
    array = _numbers(labels)
    if array is None or array.dtype.kind == "f":
        raise TypeError(f"`labels` must be whole numbers, not {_name(labels)}.")
    if array.shape != (mesh.n_polygons,) or array.min() < 0:
        raise DecompositionError(
            f"`labels` must be {mesh.n_polygons} numbers from 0, one for each face."
        )
    return array.astype(np.int64)


def _is_blender_object(shape: object) -> bool:
    """Return whether a shape is a Blender object; TypeError for other Blender data."""
    kind = getattr(shape, "bl_rna", None)
    if kind is None:
        return False
    if kind.identifier != "Object":
        raise TypeError(
            f"A shape cannot be a {kind.identifier} of Blender; pass the object that"
            " has it."
        )
    _check_readable(shape)
    return True


def _check_readable(obj: Any) -> None:
    """Raise if a Blender object has neither faces nor points."""
    from ..refusals import CONVERTIBLE

    if obj.type not in CONVERTIBLE | {"MESH", "POINTCLOUD"}:
        raise DecompositionError(
            f"{obj.name} is not a mesh; pass a mesh or a point cloud."
        )


def _vertices_of(shape: object) -> NDArray[np.float64]:
    """Return the vertices (V, 3) that a script passed."""
    vertices = _numbers(shape)
    if vertices is None:
        raise TypeError(f"A shape must be {_SHAPES}, not {_name(shape)}.")
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise DecompositionError(
            f"Vertices must be an array of shape (V, 3), not {vertices.shape}; pass one"
            " row of x, y and z for each."
        )
    return vertices.astype(np.float64)


def _triangles_of(
    vertices: NDArray[np.float64], faces: object
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the triangles (T, 3) of faces, and the face (T,) of each."""
    array = _numbers(faces)
    if array is not None and array.ndim == 2 and array.shape[1] == 3:
        return _indices(array), np.arange(len(array))
    if not isinstance(faces, Sequence | np.ndarray):
        raise TypeError(
            f"`faces` must be rows of vertex numbers, (F, 3) or lists of any length,"
            f" not {_name(faces)}."
        )
    if array is not None and array.ndim == 2 and array.shape[1] > 3:
        polygons = list(_indices(array))
    else:
        polygons = [_polygon(face, row) for row, face in enumerate(faces)]
    if polygons and np.concatenate(polygons).max() >= len(vertices):
        raise DecompositionError(
            "The mesh has faces that refer to missing vertices; repair it first."
        )
    return triangulate(vertices, polygons)


def _polygon(face: object, row: int) -> NDArray[np.int64]:
    """Return the vertex numbers of one face, (N,), N at least 3."""
    corners = _numbers(face)
    if corners is None or corners.ndim != 1:
        raise TypeError(f"Face {row} is no list of vertex numbers, but {_name(face)}.")
    if len(corners) < 3:
        raise DecompositionError(
            f"Face {row} has {len(corners)} corners; leave out faces of fewer than 3."
        )
    return _indices(corners)


def _numbers(values: object) -> NDArray[Any] | None:
    """Return an array of real numbers; None if values are ragged or no numbers."""
    if values is None or isinstance(values, str | bytes):
        return None
    try:
        array = np.asarray(values)
    except (TypeError, ValueError):  # ragged, or an object that cannot be an array
        return None
    return array if array.dtype.kind in "iuf" else None


def _indices(array: NDArray[Any]) -> NDArray[np.int64]:
    """Return vertex numbers as integers; raise if one is negative or not whole."""
    if array.dtype.kind == "f" and array.size:
        raise TypeError("`faces` must be whole numbers: rows of the vertices.")
    if array.size and array.min() < 0:
        raise DecompositionError(
            "The mesh has faces that refer to missing vertices; repair it first."
        )
    return array.astype(np.int64)


def _name(thing: object) -> str:
    """Return how an error message names a value: by its type."""
    return f"a value of type {type(thing).__name__}"
