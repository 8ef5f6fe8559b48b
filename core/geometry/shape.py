"""The two kinds of shape, when two are equal, and what fits to their faces."""

from __future__ import annotations

from dataclasses import fields
from hashlib import blake2b
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import DecompositionError
from ..steps.arrays import IntArray
from .array_checks import checked_numbers, described
from .mesh import TriangleMesh
from .point_cloud import PointCloud

Shape = TriangleMesh | PointCloud


def are_equal(shape: Shape, other: Shape) -> bool:
    """Return whether two shapes are of one kind, and all their arrays are equal.

    Parameters
    ----------
    shape, other : TriangleMesh or PointCloud

    Returns
    -------
    bool
    """
    arrays, others = _arrays(shape), _arrays(other)
    if type(shape) is not type(other) or len(arrays) != len(others):
        return False
    pairs = zip(arrays, others, strict=True)
    return all(one is two or np.array_equal(one, two) for one, two in pairs)


def digest_of(shape: Shape) -> bytes:
    """Return a hash of what `are_equal` compares, to be used as a key.

    Parameters
    ----------
    shape : TriangleMesh or PointCloud

    Returns
    -------
    bytes
    """
    found = blake2b(type(shape).__name__.encode())
    for array in _arrays(shape):
        found.update(f"{array.dtype} {array.shape}".encode())
        found.update(np.ascontiguousarray(array).data)
    return found.digest()


def size_of(shape: Shape) -> int:
    """Return how many numbers a shape is made of.

    Parameters
    ----------
    shape : TriangleMesh or PointCloud

    Returns
    -------
    int
    """
    return sum(array.size for array in _arrays(shape))


def check_members(members: object, shape: Shape) -> None:
    """Raise an error if an argument does not choose faces, or points, of a shape.

    Parameters
    ----------
    members : object
        (P,) bool, or None for all.
    shape : TriangleMesh or PointCloud

    Raises
    ------
    TypeError
        If it is no array of bool.
    DecompositionError
        If it has another length, or chooses none.
    """
    if members is None:
        return
    if not isinstance(members, np.ndarray) or members.dtype != np.bool_:
        raise TypeError(
            f"`members` must be an array of bool, not {described(members)}."
        )
    size = shape.n_polygons if isinstance(shape, TriangleMesh) else len(shape)
    if members.shape != (size,) or not members.any() or np.ma.is_masked(members):
        raise DecompositionError(
            f"`members` must be {size} values, one for each face or point, none of"
            " them masked, and at least one True."
        )


def checked_labels(labels: object, mesh: TriangleMesh, needed: bool) -> IntArray | None:
    """Return the labels of the faces of a mesh, after checking them.

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
    array = checked_numbers(labels, "`labels`", whole=True).astype(np.int64)
    # Numbers beyond the type have become negative.
    if array.shape != (mesh.n_polygons,) or array.min() < 0:
        raise DecompositionError(
            f"`labels` must be {mesh.n_polygons} numbers from 0 to 2**63 - 1, one for"
            " each face."
        )
    return array


def _arrays(shape: Shape) -> list[NDArray[Any]]:
    """Return all arrays of a shape; a cloud without normals has one."""
    arrays = (getattr(shape, field.name) for field in fields(shape))
    return [array for array in arrays if array is not None]
