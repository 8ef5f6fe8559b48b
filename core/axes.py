"""Axes: around a direction, and along what points extend."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


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
