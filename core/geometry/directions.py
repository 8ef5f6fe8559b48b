"""Directions spread evenly over a sphere, or around normals."""

from __future__ import annotations

import numpy as np

from ..steps.arrays import FloatArray
from .frames import cross, frames


def sphere_directions(count: int) -> FloatArray:
    """Return unit vectors spread evenly over the sphere.

    Parameters
    ----------
    count : int

    Returns
    -------
    (count, 3) float
        Points of a Fibonacci spiral, from the top down.
    """
    heights = 1 - (2 * np.arange(count) + 1) / count
    turns = np.pi * (1 + np.sqrt(5)) * np.arange(count)
    radii = np.sqrt(1 - heights**2)
    return np.stack([radii * np.cos(turns), radii * np.sin(turns), heights], axis=1)


def cone_directions(normals: FloatArray, n_rays: int, opening: float) -> FloatArray:
    """Return directions spread evenly in a cone around each inward normal.

    Parameters
    ----------
    normals : (N, 3) float
        Outward unit vectors.
    n_rays : int
        Directions r in each cone.
    opening : float
        Full angle of the cone in radians.

    Returns
    -------
    directions : (N, r, 3) float
        Unit vectors, on a spiral. Each covers the same solid angle.
    """
    steps = np.arange(n_rays) + 0.5
    heights = 1.0 - steps / n_rays * (1.0 - np.cos(opening / 2))
    radii = np.sqrt(1.0 - heights**2)
    turns = steps * np.pi * (3.0 - np.sqrt(5.0))
    tangents, bitangents = frames(normals)
    return (
        -normals[:, None] * heights[:, None]
        + tangents[:, None] * (radii * np.cos(turns))[:, None]
        + bitangents[:, None] * (radii * np.sin(turns))[:, None]
    )


def fan_directions(
    normals: FloatArray, n_rays: int, opening: float, plane: FloatArray
) -> FloatArray:
    """Return directions in a plane, spread evenly around each inward normal.

    Parameters
    ----------
    normals : (N, 3) float
        Outward unit vectors in the plane.
    n_rays : int
        Directions r in each fan.
    opening : float
        Full angle of the fan in radians.
    plane : (3,) float
        Unit normal of the plane.

    Returns
    -------
    directions : (N, r, 3) float
        Unit vectors in the plane.
    """
    angles = ((np.arange(n_rays) + 0.5) / n_rays - 0.5) * opening
    sideways = cross(np.broadcast_to(plane, normals.shape), normals)
    return (
        -normals[:, None] * np.cos(angles)[:, None]
        + sideways[:, None] * np.sin(angles)[:, None]
    )
