"""The two kinds of shape, mesh and point cloud, and whether two shapes are equal."""

from __future__ import annotations

from dataclasses import fields
from hashlib import blake2b
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
    if type(shape) is not type(other):
        return False
    return all(
        one is two or (one is not None and two is not None and np.array_equal(one, two))
        for one, two in zip(_arrays(shape), _arrays(other), strict=True)
    )


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
        if array is not None:
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
    return sum(array.size for array in _arrays(shape) if array is not None)


def _arrays(shape: Shape) -> list[NDArray[Any] | None]:
    """Return all arrays of a shape."""
    return [getattr(shape, field.name) for field in fields(shape)]
