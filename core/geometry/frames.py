"""Unit vectors, axes and heights above planes."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Real = TypeVar("Real", np.float32, np.float64)


def unit(vectors: NDArray[Real]) -> NDArray[Real]:
    """Return vectors (N, 3) with length 1, those without direction as they are."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, lengths, out=vectors.copy(), where=lengths > 0)


def frames(
    normals: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return two unit vectors that complete each normal to a frame."""
    helpers = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    tangents = np.asarray(np.cross(normals, helpers), dtype=np.float64)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    return tangents, np.asarray(np.cross(normals, tangents), dtype=np.float64)


def principal_axes(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the principal axes of points (N, 3) as rows, shortest first, (3, 3)."""
    spread = points - points.mean(axis=0)
    axes: NDArray[np.float64] = np.linalg.eigh(spread.T @ spread)[1].T
    return axes


def heights_above(
    planes: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the heights of points (M, 3) above planes n · x + d = 0 (P, 4), (M, P)."""
    heights: NDArray[np.float64] = points @ planes[:, :3].T + planes[:, 3]
    return heights
