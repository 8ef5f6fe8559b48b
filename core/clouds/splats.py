"""Splats: triangles around oriented points, for rays to hit (section 5)."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..geometry.frames import frames, with_normals
from ..geometry.mesh import TriangleMesh
from ..geometry.sampling import sample_surface
from ..steps.arrays import FloatArray, IntArray

# Neighbors that the density around a point is measured with.
_NEIGHBORS = 8
# Area of a splat, as a multiple of the area that its point stands for.
_COVER = 1.5
# Bounds of a point's area, as multiples of the median. Points may coincide, and some
# are strays.
_LEAST_AREA, _MOST_AREA = 0.02, 25.0
# Distance, in spacings of points, that opposite normals add.
_NORMAL_WEIGHT = 3.0
# Points that spacing and noise are measured at, at most.
_PROBES = 1000
# Points in each neighborhood that noise is measured in, with the point itself.
_NEAREST = 10
# Quantile of the measured noise that is used: neighborhoods at edges are thick
# without noise.
_FLATTEST = 0.2
# Points that noise is averaged over, with the point itself.
_AVERAGED = 12
# Most splats of a cloud. Clouds of more points are thinned out.
_MOST_SPLATS = 20_000


def normal_weight(points: FloatArray) -> float:
    """Return the distance that normals one unit apart add when points are compared.

    Parameters
    ----------
    points : (N, 3) float

    Returns
    -------
    float
        In the units of `points`: a multiple of the median side of the square that a
        point stands for.
    """
    probes = points[:: -(-len(points) // _PROBES)]
    distances, _ = cKDTree(points).query(probes, _NEIGHBORS + 1)
    areas = np.pi * distances[:, -1] ** 2 / _NEIGHBORS
    return _NORMAL_WEIGHT / 2 * float(np.sqrt(np.median(areas)))


def nearest_points(
    points: FloatArray,
    normals: FloatArray,
    n_nearest: int,
    queries: tuple[FloatArray, FloatArray] | None = None,
) -> IntArray:
    """Return the points nearest to each one, or to others, by position and normal.

    Points on the far side of a thin wall do not count as near.

    Parameters
    ----------
    points, normals : (N, 3) float
    n_nearest : int
        At most N.
    queries : tuple of two (Q, 3) float, optional
        Positions and normals of others.

    Returns
    -------
    (Q, n_nearest) int
        Rows of `points`, nearest first.
    """
    weight = normal_weight(points)
    places = with_normals(points, normals, weight)
    asked = places if queries is None else with_normals(*queries, weight)
    _, nearest = cKDTree(places).query(asked, n_nearest)
    return nearest.reshape(len(asked), n_nearest).astype(np.int64)


def noise_of(points: FloatArray) -> float:
    """Return the noise of a cloud: thickness of small neighborhoods over their width.

    It is 0 where points lie exactly in planes, and somewhat above 0.5 where they fill a
    volume.

    Parameters
    ----------
    points : (N, 3) float

    Returns
    -------
    float
        A ratio, without unit.
    """
    probes = points[:: -(-len(points) // _PROBES)]
    _, nearest = cKDTree(points).query(probes, min(_NEAREST, len(points)))
    near = points[nearest]
    spread = near - near.mean(axis=1, keepdims=True)
    variances = np.linalg.eigvalsh(np.einsum("nki,nkj->nij", spread, spread))
    variances = np.maximum(variances, np.finfo(float).tiny)
    thickness = np.sqrt(variances[:, 0] / variances[:, 1])
    return float(np.quantile(thickness, _FLATTEST))


def areas_of_points(points: FloatArray, normals: FloatArray) -> FloatArray:
    """Return the surface area that each point stands for, by the density around it.

    Parameters
    ----------
    points, normals : (N, 3) float

    Returns
    -------
    (N,) float
    """
    nearest = nearest_points(points, normals, _NEIGHBORS + 1)
    radii = np.linalg.norm(points[nearest] - points[:, None], axis=2).max(axis=1)
    areas = np.pi * radii**2 / _NEIGHBORS
    median = np.median(areas[areas > 0]) if areas.any() else 1.0
    return np.clip(areas, _LEAST_AREA * median, _MOST_AREA * median)


def smoothed(points: FloatArray, normals: FloatArray) -> FloatArray:
    """Return points moved along their normals to average out noise.

    The height of each neighbor is measured with the mean of the two normals. A chord of
    a circle is at right angles to that mean, so curvature alone moves no point.

    Parameters
    ----------
    points, normals : (N, 3) float

    Returns
    -------
    (N, 3) float
    """
    nearest = nearest_points(points, normals, min(_AVERAGED, len(points)))
    chords = points[nearest] - points[:, None]
    heights = np.einsum("nkd,nkd->nk", chords, normals[nearest] + normals[:, None]) / 2
    return points + heights.mean(axis=1)[:, None] * normals


def splats(points: FloatArray, normals: FloatArray, areas: FloatArray) -> TriangleMesh:
    """Return a triangle around each point that faces along its normal.

    Parameters
    ----------
    points, normals : (N, 3) float
    areas : (N,) float
        Surface area that each point stands for. Its splat is half as large again.

    Returns
    -------
    TriangleMesh
        Triangle i and polygon i are the splat of point i.
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
    points: FloatArray, normals: FloatArray
) -> tuple[IntArray, FloatArray, TriangleMesh]:
    """Thin out a cloud of many points, and return the kept points' areas and splats.

    Kept points are spread evenly over the surface, even if the density of the cloud
    varies.

    Parameters
    ----------
    points, normals : (N, 3) float

    Returns
    -------
    kept : (M,) int
        Rows of `points`, ascending; all of them if they are few enough.
    areas : (M,) float
        Surface area that each kept point stands for.
    targets : TriangleMesh
        Triangle i is the splat of kept point i.
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
