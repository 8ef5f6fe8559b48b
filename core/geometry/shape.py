"""The two kinds of shape, mesh and point cloud, and a key of their content."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import fields
from hashlib import blake2b
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .mesh import TriangleMesh
from .point_cloud import PointCloud

Shape = TriangleMesh | PointCloud


def content_key(shape: Shape) -> Hashable:
    """Return a key that two shapes share only if all their arrays are equal.

    Parameters
    ----------
    shape : TriangleMesh or PointCloud

    Returns
    -------
    hashable
        The shape's class and a digest of its arrays.
    """
    digest = blake2b()
    for field in fields(shape):
        array: NDArray[Any] | None = getattr(shape, field.name)
        digest.update(f"{field.name} {None if array is None else array.shape}".encode())
        if array is not None:
            digest.update(np.ascontiguousarray(array).data)
    return type(shape), digest.digest()
