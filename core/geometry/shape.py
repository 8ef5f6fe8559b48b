"""The two kinds of shape, mesh and point cloud, and whether two shapes are equal."""

from __future__ import annotations

from dataclasses import fields

import numpy as np

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
    pairs = ((getattr(shape, f.name), getattr(other, f.name)) for f in fields(shape))
    return all(
        one is two or (one is not None and two is not None and np.array_equal(one, two))
        for one, two in pairs
    )
