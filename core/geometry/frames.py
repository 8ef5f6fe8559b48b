"""Unit vectors, coordinate axes and heights above planes."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Real = TypeVar("Real", np.float32, np.float64)


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


def frames(
    normals: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
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
    tangents = np.asarray(np.cross(normals, helpers), dtype=np.float64)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    return tangents, np.asarray(np.cross(normals, tangents), dtype=np.float64)


def principal_axes(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the principal axes of points, the one of least variance first.

    Parameters
    ----------
    points : (N, 3) float

    Returns
    -------
    (3, 3) float
        Unit vectors as rows.
    """
    spread = points - points.mean(axis=0)
    axes: NDArray[np.float64] = np.linalg.eigh(spread.T @ spread)[1].T
    return axes


def heights_above(
    planes: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the signed heights of points above planes n · x + d = 0.

    Parameters
    ----------
    planes : (P, 4) float
        Unit normal n and offset d of each plane.
    points : (M, 3) float

    Returns
    -------
    (M, P) float
    """
    heights: NDArray[np.float64] = points @ planes[:, :3].T + planes[:, 3]
    return heights
