"""From the space of an object to the proportions that it has in the scene, and back.

A stretch is a symmetric matrix, (3, 3), of determinant 1: see `shape.stretch`. It is
diagonal where no parent shears the object.
"""

from __future__ import annotations

import numpy as np

from ....core.steps.arrays import FloatArray

# Largest cosine of the angle between two axes at a right angle: places of objects are
# products of matrices in single precision.
_NO_SHEAR = 1e-5


def stretched(rows: FloatArray, stretch: FloatArray) -> FloatArray:
    """Return points or directions in object space, (..., 3), as they are stretched."""
    return rows * np.diagonal(stretch) if is_diagonal(stretch) else rows @ stretch


def unstretched(rows: FloatArray, stretch: FloatArray) -> FloatArray:
    """Return stretched points or directions, (..., 3), in object space.

    Normals go the other way: this stretches those of object space.
    """
    if is_diagonal(stretch):
        return rows / np.diagonal(stretch)
    return rows @ np.linalg.inv(stretch)


def is_diagonal(matrix: FloatArray) -> bool:
    """Return whether a matrix is nothing but a factor for each axis."""
    return np.count_nonzero(matrix) == np.count_nonzero(np.diagonal(matrix))


def scaling(scale: FloatArray, axes: FloatArray) -> FloatArray:
    """Return the symmetric matrix that scales along axes: columns of a matrix (3, 3).

    If it is not diagonal, it is in single precision, as the matrix of an object is: the
    rest would be noise.
    """
    matrix: FloatArray = (axes * scale) @ axes.T
    return matrix if is_diagonal(matrix) else matrix.astype(np.float32).astype(float)


def sheared_scale(matrix: FloatArray) -> tuple[FloatArray, FloatArray] | None:
    """Return the scale of a matrix along axes of its own, if it shears.

    By its polar decomposition into a rotation, or its mirror image, and a symmetric
    matrix, whose eigenvalues and eigenvectors these are.

    Parameters
    ----------
    matrix : (3, 3) float
        It may have columns that are 0 or no numbers: that is no shear.

    Returns
    -------
    scale : (3,) float
        The largest first, none below 0. What single precision takes for 0 is 0.
    axes : (3, 3) float
        Their columns are orthonormal.
    """
    lengths = np.linalg.norm(matrix, axis=0)
    if not np.isfinite(lengths).all() or not lengths.all():
        return None
    columns = matrix / lengths
    if np.abs(columns.T @ columns - np.eye(3)).max() <= _NO_SHEAR:
        return None
    _, scale, axes = np.linalg.svd(matrix)
    return np.where(scale > np.finfo(np.float32).eps * scale[0], scale, 0.0), axes.T
