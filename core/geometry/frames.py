"""Unit vectors, coordinate axes, cross products, heights above planes, moved points."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..steps.arrays import FloatArray, IntArray

# Heights of points above planes computed at once: more fit into no processor's cache.
HEIGHTS_AT_ONCE = 100_000

# Decimal digits of what processors and libraries, which round differently, agree on.
_SURE_DIGITS = 10

Real = TypeVar("Real", np.float32, np.float64)


def settled(numbers: FloatArray) -> FloatArray:
    """Return numbers rounded so far that they are the same on any processor.

    Later steps tell equal ones apart, or take sides of a plane: a last digit would
    decide.

    Parameters
    ----------
    numbers : (...) float
        About 1 in size, such as coordinates where the longest side is 2.

    Returns
    -------
    (...) float
    """
    return np.round(numbers, _SURE_DIGITS)


def unit(vectors: NDArray[Real]) -> NDArray[Real]:
    """Return the vectors scaled to length 1; zero vectors stay zero.

    Parameters
    ----------
    vectors : (N, 3) float32 or float64

    Returns
    -------
    (N, 3) of the same dtype
    """
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, lengths, out=vectors.copy(), where=lengths > 0)


def frames(normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return two unit vectors at right angles to each normal and to each other.

    Parameters
    ----------
    normals : (N, 3) float
        Unit vectors.

    Returns
    -------
    tangents, bitangents : (N, 3) float
    """
    helpers = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    tangents = cross(normals, helpers)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    return tangents, cross(normals, tangents)


def frame_of(axis: FloatArray) -> FloatArray:
    """Return right-handed axes whose last row is a given one.

    Parameters
    ----------
    axis : (3,) float
        Unit vector.

    Returns
    -------
    (3, 3) float
    """
    return np.concatenate([*frames(axis[None]), axis[None]])


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return cross products; for few vectors in a third of NumPy's time.

    Parameters
    ----------
    a, b : (..., 3) float

    Returns
    -------
    (..., 3) float
    """
    product = np.empty(a.shape)
    for axis in range(3):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        product[..., axis] = a[..., i] * b[..., j] - a[..., j] * b[..., i]
    return product


def area_vectors(corners: FloatArray) -> FloatArray:
    """Return normals of triangles, each twice as long as the triangle's area.

    Parameters
    ----------
    corners : (..., 3, 3) float
        Counter-clockwise seen from where the normals point.

    Returns
    -------
    (..., 3) float
    """
    a = corners[..., 0, :]
    return cross(corners[..., 1, :] - a, corners[..., 2, :] - a)


def cross_2d(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return cross products in the plane: above 0 where `b` is to the left of `a`.

    Parameters
    ----------
    a, b : (..., 2) float

    Returns
    -------
    (...) float
    """
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def distinct_directions(
    normals: FloatArray, digits: int
) -> tuple[FloatArray, IntArray]:
    """Return the directions of normals, and how many normals have each.

    Parameters
    ----------
    normals : (N, 3) float
        Unit vectors. Equal and opposite ones have one direction.
    digits : int
        Decimal digits to which equal normals agree.

    Returns
    -------
    directions : (D, 3) float
        In the order of the first normal of each. Largest coordinates are positive.
    counts : (D,) int
    """
    found = one_way(normals, digits)
    _, rows, counts = np.unique(
        np.round(found, digits), axis=0, return_index=True, return_counts=True
    )
    order = np.argsort(rows)
    return found[rows[order]], counts[order]


def one_way(normals: FloatArray, digits: int) -> FloatArray:
    """Return normals (N, 3), turned so that the largest coordinate is positive.

    It is the first one that is largest when rounded to so many decimal digits: so
    rounding decides no signs.
    """
    rounded = np.round(normals, digits)
    largest = np.abs(rounded).argmax(axis=1)[:, None]
    return np.sign(np.take_along_axis(rounded, largest, axis=1)) * normals


def principal_axes(points: FloatArray) -> FloatArray:
    """Return the principal axes of points, the one of least variance first.

    Parameters
    ----------
    points : (N, 3) float

    Returns
    -------
    (3, 3) float
        Unit vectors as rows, the same on any processor.
    """
    spread = points - points.mean(axis=0)
    return unit(settled(np.linalg.eigh(spread.T @ spread)[1].T))


def coordinates_along(
    directions: NDArray[Real], points: NDArray[Real]
) -> NDArray[Real]:
    """Return the coordinates of points along directions, to the bit on any processor.

    Matrix products are rounded as the processor likes, and the last digit decides on
    which side of a plane points in it are.

    Parameters
    ----------
    directions : (D, 3) float32 or float64
    points : (..., 3) of the same dtype

    Returns
    -------
    (..., D) of the same dtype
    """
    x, y, z = np.moveaxis(points, -1, 0)[..., None]
    across, up, out = directions.T
    return x * across + y * up + z * out


def moved(points: NDArray[Real], matrix: NDArray[Real]) -> NDArray[Real]:
    """Return points, (..., 3), moved by a matrix (4, 4) from their space to another."""
    return coordinates_along(matrix[:3, :3], points) + matrix[:3, 3]


def heights_above(planes: FloatArray, points: FloatArray) -> FloatArray:
    """Return the signed heights of points above planes n · x + d = 0.

    Parameters
    ----------
    planes : (P, 4) float
        Unit normal n and offset d of each plane.
    points : (..., 3) float

    Returns
    -------
    (..., P) float
    """
    return coordinates_along(planes[:, :3], points) + planes[:, 3]


def with_normals(points: FloatArray, normals: FloatArray, weight: float) -> FloatArray:
    """Return coordinates whose distances combine positions and normals.

    The two sides of a thin wall are close, but their normals point away from each
    other. In these coordinates they are apart.

    Parameters
    ----------
    points, normals : (N, 3) float
    weight : float
        Distance that normals one unit apart add.

    Returns
    -------
    (N, 6) float
    """
    return np.hstack([points, weight * normals])
