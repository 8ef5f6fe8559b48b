"""Convex hulls: of any points, outwards, of few vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, HalfspaceIntersection, QhullError

from ..geometry.frames import heights_above, principal_axes
from ..geometry.primitives import Hull

# Vertices that a simplified hull gets in each round, at least.
_VERTICES_A_ROUND = 6


def convex_hull(points: NDArray[np.float64], thin: float) -> Hull:
    """Return the convex hull of points.

    Parameters
    ----------
    points : (N, 3) float
        One or more; any may coincide or lie in a line or a plane.
    thin : float
        Thickness that the hull gets where the points have none.
    """
    try:
        return _hull(points)
    except (QhullError, ValueError):  # ValueError: fewer points than Qhull takes
        return _hull(_thickened(points, thin))


def hull_volume(points: NDArray[np.float64]) -> float:
    """Return the volume of the convex hull of points (N, 3), 0 if they are flat."""
    try:
        return float(ConvexHull(points).volume)
    except (QhullError, ValueError):  # ValueError: fewer points than Qhull takes
        return 0.0


def simplified(hull: Hull, max_vertices: int, tolerance: float) -> Hull:
    """Return the hull of some of the vertices of a hull.

    Vertices are taken where they are farthest out of those taken before.

    Parameters
    ----------
    hull : Hull
    max_vertices : int
        4 or more.
    tolerance : float
        Vertices that are less far out are left out, however many there may be: single
        precision makes creases of what is nearly flat.
    """
    chosen = _tetrahedron(hull.vertices)
    coarse = _hull(hull.vertices[chosen])
    while True:
        heights = heights_above(coarse.planes, hull.vertices)
        facets = np.argsort(-heights.max(axis=0), kind="stable")
        facets = facets[heights.max(axis=0)[facets] > tolerance]
        # Several facets may have the same vertex farthest out of them.
        new = list(dict.fromkeys(heights.argmax(axis=0)[facets].tolist()))
        fresh = max(_VERTICES_A_ROUND, len(chosen) // 3)
        room = min(fresh, max_vertices - len(chosen))
        if room == 0 or not new:
            return coarse
        chosen += new[:room]
        coarse = _hull(hull.vertices[chosen])


def offset(hull: Hull, margin: float) -> Hull:
    """Return the hull with its planes moved outwards, or inwards, by `margin`.

    One that would vanish stays as it is.
    """
    if margin == 0:
        return hull
    planes = hull.planes - [0, 0, 0, margin]
    inside = hull.vertices.mean(axis=0)
    if heights_above(planes, inside[None]).max() >= 0:
        return hull
    try:
        return _hull(HalfspaceIntersection(planes, inside).intersections)
    except QhullError:
        return hull


def directions(count: int) -> NDArray[np.float64]:
    """Return unit vectors spread evenly over the sphere, (count, 3)."""
    heights = 1 - (2 * np.arange(count) + 1) / count
    turns = np.pi * (1 + np.sqrt(5)) * np.arange(count)
    radii = np.sqrt(1 - heights**2)
    return np.stack([radii * np.cos(turns), radii * np.sin(turns), heights], axis=1)


def _hull(points: NDArray[np.float64]) -> Hull:
    """Return the hull of points that are not flat; raises what Qhull raises."""
    found = ConvexHull(points)
    rows = np.full(len(points), -1)
    rows[found.vertices] = np.arange(len(found.vertices))
    a, b, c = np.moveaxis(points[found.simplices], 1, 0)
    normals = np.cross(b - a, c - a)
    inwards = np.einsum("fd,fd->f", normals, found.equations[:, :3]) < 0
    triangles = found.simplices.astype(np.int64)
    triangles[inwards] = triangles[inwards, ::-1]
    return Hull(
        points[found.vertices],
        rows[triangles],
        np.asarray(found.equations),
        float(found.volume),
    )


def _thickened(points: NDArray[np.float64], thin: float) -> NDArray[np.float64]:
    """Return points with copies on both sides wherever they are thinner than `thin`."""
    center = points.mean(axis=0)
    for axis in principal_axes(points):
        heights = (points - center) @ axis
        if np.ptp(heights) < thin:
            flat = points - heights[:, None] * axis
            points = np.concatenate([flat + thin / 2 * axis, flat - thin / 2 * axis])
    return points


def _tetrahedron(points: NDArray[np.float64]) -> list[int]:
    """Return four rows of points that span a volume: each far from those before."""
    rows = [int(np.linalg.norm(points - points.mean(axis=0), axis=1).argmax())]
    offsets = points - points[rows[0]]
    for _ in range(3):
        lengths = np.linalg.norm(offsets, axis=1)
        rows.append(int(lengths.argmax()))
        direction = offsets[rows[-1]] / lengths.max()
        offsets = offsets - np.outer(offsets @ direction, direction)
    return rows
