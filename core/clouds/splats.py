"""Oriented points as splats: triangles that rays are cast at (section 5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..geometry.frames import frames
from ..geometry.mesh import TriangleMesh
from ..geometry.sampling import sample_surface

# Neighbors that the density around a point is told from.
_NEIGHBORS = 8
# Area of a splat, in the area that its point stands for.
_COVER = 1.5
# Bounds of that area, in its median: points may coincide, and some are strays.
_LEAST_AREA, _MOST_AREA = 0.02, 25.0
# How far apart two points of opposite normals count, in spacings of points.
_NORMAL_WEIGHT = 3.0
# Points that their spacing is measured on.
_PROBES = 1000
# Neighbors, with the point itself, that noise is averaged over.
_AVERAGED = 12
# Points that become splats; more are thinned out to so many.
_MOST_SPLATS = 20_000


def spacing_of(points: NDArray[np.float64]) -> float:
    """Return the side of the square that a point stands for in the median."""
    probes = points[:: -(-len(points) // _PROBES)]
    return float(np.sqrt(np.median(_areas_around(points, probes))))


def nearest_points(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    queries: tuple[NDArray[np.float64], NDArray[np.float64]],
    n_nearest: int,
) -> NDArray[np.int64]:
    """Return the points nearest to each query by position and normal, (Q, n).

    The far side of a thin wall does not count as near.

    Parameters
    ----------
    points, normals : (N, 3) float
    queries : two (Q, 3) float
        Positions and normals.
    n_nearest : int
        Not above N.
    """
    spacing = spacing_of(points)
    tree = cKDTree(placed(points, normals, spacing))
    _, nearest = tree.query(placed(*queries, spacing), n_nearest)
    return nearest.reshape(len(queries[0]), n_nearest).astype(np.int64)


def placed(
    points: NDArray[np.float64], normals: NDArray[np.float64], spacing: float
) -> NDArray[np.float64]:
    """Return coordinates (N, 6) whose distances count positions and normals.

    Parameters
    ----------
    points, normals : (N, 3) float
    spacing : float
        Of the cloud.
    """
    return np.hstack([points, _NORMAL_WEIGHT / 2 * spacing * normals])


def areas_of_points(
    points: NDArray[np.float64], normals: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the area that each point stands for, by the density around it, (N,)."""
    nearest = nearest_points(points, normals, (points, normals), _NEIGHBORS + 1)
    radii = np.linalg.norm(points[nearest] - points[:, None], axis=2).max(axis=1)
    areas = np.pi * radii**2 / _NEIGHBORS
    median = np.median(areas[areas > 0]) if areas.any() else 1.0
    return np.clip(areas, _LEAST_AREA * median, _MOST_AREA * median)


def smoothed(
    points: NDArray[np.float64], normals: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return points (N, 3) moved along their normals to where their neighbors agree.

    Noise is averaged away. The chord between two points of a circle is at right angles
    to the sum of their normals, so that curvature alone moves nothing.
    """
    nearest = nearest_points(
        points, normals, (points, normals), min(_AVERAGED, len(points))
    )
    chords = points[nearest] - points[:, None]
    heights = np.einsum("nkd,nkd->nk", chords, normals[nearest] + normals[:, None]) / 2
    moved: NDArray[np.float64] = points + heights.mean(axis=1)[:, None] * normals
    return moved


def splats(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    areas: NDArray[np.float64],
) -> TriangleMesh:
    """Return a triangle around each point that faces along its normal.

    Parameters
    ----------
    points, normals : (N, 3) float
    areas : (N,) float
        What each point stands for; its splat is half as large again.

    Returns
    -------
    TriangleMesh
        Triangle and polygon i are the splat of point i.
    """
    tangents, bitangents = frames(normals)
    radii = np.sqrt(_COVER * areas * 4 / (3 * np.sqrt(3.0)))[:, None]
    turns = 2 * np.pi * np.arange(3) / 3
    corners = [
        points + radii * (tangents * np.cos(turn) + bitangents * np.sin(turn))
        for turn in turns
    ]
    numbers = np.arange(len(points))
    return TriangleMesh(
        np.stack(corners, axis=1).reshape(-1, 3),
        np.arange(3 * len(points)).reshape(-1, 3),
        numbers,
    )


def thinned_splats(
    points: NDArray[np.float64], normals: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64], TriangleMesh]:
    """Return the points that are kept, the areas they stand for, and their splats.

    What is kept is spread evenly over the surface, however uneven the density.

    Parameters
    ----------
    points, normals : (N, 3) float

    Returns
    -------
    kept : (M,) int
        Ascending; all points if there are not too many.
    areas : (M,) float
    targets : TriangleMesh
    """
    kept = np.arange(len(points))
    areas = areas_of_points(points, normals)
    targets = splats(points, normals, areas)
    if len(points) > _MOST_SPLATS:
        rng = np.random.default_rng(0)
        kept = np.unique(sample_surface(targets, _MOST_SPLATS, rng).triangles)
        areas = areas_of_points(points[kept], normals[kept])
        targets = splats(points[kept], normals[kept], areas)
    return kept, areas, targets


def _areas_around(
    points: NDArray[np.float64], probes: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the area that a point stands for around each of the probes."""
    distances, _ = cKDTree(points).query(probes, _NEIGHBORS + 1)
    areas: NDArray[np.float64] = np.pi * distances[:, -1] ** 2 / _NEIGHBORS
    return areas
