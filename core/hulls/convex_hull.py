"""Compute convex hulls, simplify them to few vertices and offset their faces."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, HalfspaceIntersection, QhullError

from ..geometry.frames import (
    HEIGHTS_AT_ONCE,
    coordinates_along,
    heights_above,
    principal_axes,
)
from ..geometry.primitives import Hull
from ..steps.arrays import FloatArray, IntArray
from ..steps.rows import blocks

# Thickness of the hulls of flat pieces; the longest side of the shape is 2.
THIN = 2e-3
# Simplified hulls may leave out vertices that are less than this far outside.
LEFT_OUT = THIN / 10
# Of thinner hulls, even less: at a sharp edge, a vertex may be close to the planes of
# both faces, but far from where they meet.
_THICK = 0.1
# Less than this share of it is rounding: vertices are in single precision.
_ROUNDING = 2e-3
# Least number of vertices added to a simplified hull in each round.
_VERTICES_A_ROUND = 6


def convex_hull(points: FloatArray, thin: float) -> Hull:
    """Return the convex hull of points.

    Parameters
    ----------
    points : (N, 3) float
        One point or more. They may coincide, or lie on a line or in a plane.
    thin : float
        Thickness of the hull of flat points, in the unit of the points.

    Returns
    -------
    Hull
        Triangles face outwards.
    """
    try:
        hull = _hull(points)
    except (QhullError, ValueError):  # ValueError: fewer points than Qhull takes
        hull = None
    if hull is None or _is_flat(hull, _ROUNDING * thin):
        return replace(_hull(thickened(points, thin)), is_thickened=True)
    return hull


def hull_volume(points: FloatArray) -> float:
    """Return the volume of the convex hull of points.

    Parameters
    ----------
    points : (N, 3) float

    Returns
    -------
    float
        In the cubed unit of the points; 0 if they are flat.
    """
    try:
        return float(ConvexHull(points).volume)
    except (QhullError, ValueError):  # ValueError: fewer points than Qhull takes
        return 0.0


def thickened(points: FloatArray, thin: float) -> FloatArray:
    """Return points made at least `thin` thick along each of their principal axes.

    Parameters
    ----------
    points : (N, 3) float
    thin : float

    Returns
    -------
    (M, 3) float
        Two for each point of flat ones.
    """
    center = points.mean(axis=0)
    for axis in principal_axes(points):
        heights = coordinates_along(axis[None], points - center)
        if np.ptp(heights) < thin:
            flat = points - heights * axis
            points = np.concatenate([flat + thin / 2 * axis, flat - thin / 2 * axis])
    return points


def simplified(hull: Hull, max_vertices: int) -> Hull:
    """Return a simpler hull, made of some of the vertices of a hull.

    Starts with a tetrahedron. Each round adds the vertices that are farthest outside
    the facets of the hull so far. Vertices that are less than `LEFT_OUT` outside are
    left out, even where more are allowed: single precision turns nearly flat faces into
    creases.

    Parameters
    ----------
    hull : Hull
        The longest side of the whole shape is 2.
    max_vertices : int
        Largest number of vertices, 4 or more.

    Returns
    -------
    Hull
        It lies within `hull`.
    """
    tolerance = LEFT_OUT * min(_thickness(hull) / _THICK, 1.0)
    chosen = _tetrahedron(hull.vertices)
    coarse = _hull(hull.vertices[chosen])
    while True:
        highest, heights = _farthest_out(coarse.planes, hull.vertices)
        facets = np.argsort(-heights, kind="stable")
        # Several facets may have the same vertex farthest out of them.
        new = list(dict.fromkeys(highest[facets[heights[facets] > tolerance]].tolist()))
        fresh = max(_VERTICES_A_ROUND, len(chosen) // 3)
        room = min(fresh, max_vertices - len(chosen))
        if room == 0 or not new:
            return coarse
        chosen += new[:room]
        coarse = _hull(hull.vertices[chosen])


def offset(hull: Hull, margin: float) -> Hull:
    """Return a hull with the planes of its faces moved outwards.

    Parameters
    ----------
    hull : Hull
    margin : float
        Distance, in the unit of the hull; moves planes inwards if negative.

    Returns
    -------
    Hull
        The hull as it was if it would vanish.
    """
    if margin == 0:
        return hull
    planes = hull.planes - [0, 0, 0, margin]
    inside = hull.vertices.mean(axis=0)
    if heights_above(planes, inside[None]).max() >= 0:  # near a crowd of vertices
        inside = _deepest(hull)
    if heights_above(planes, inside[None]).max() >= 0:
        return hull
    try:
        return _hull(HalfspaceIntersection(planes, inside).intersections)
    except QhullError:
        return hull


def _hull(points: FloatArray) -> Hull:
    """Return the hull of points; raise QhullError or ValueError if they are flat."""
    found = ConvexHull(points)
    used = np.zeros(len(points), dtype=bool)
    used[found.simplices] = True
    return Hull(
        points[used],
        (np.cumsum(used) - 1)[found.simplices],
        np.asarray(found.equations),
        float(found.volume),
    )


def _is_flat(hull: Hull, thickness: float) -> bool:
    """Return whether a hull has less than a thickness along a principal axis."""
    low, high = hull.bounds
    if hull.volume > thickness * float(np.sum(high - low)) ** 2:  # the usual case
        return False
    return _thickness(hull) < thickness


def _thickness(hull: Hull) -> float:
    """Return the width of a hull along its first principal axis, the shortest."""
    return float(np.ptp(hull.vertices @ principal_axes(hull.vertices)[0]))


def _deepest(hull: Hull) -> FloatArray:
    """Return the center (3,) of a largest ball within a hull."""
    normals, offsets = hull.planes[:, :3], hull.planes[:, 3]
    found = linprog(
        (0, 0, 0, -1),
        np.c_[normals, np.ones(len(normals))],
        -offsets,
        bounds=[(None, None)] * 3 + [(0, None)],
    )
    return found.x[:3]


def _farthest_out(
    planes: FloatArray, points: FloatArray
) -> tuple[IntArray, FloatArray]:
    """Return the row of the point highest above each plane, (P,), and its height."""
    rows, heights = np.empty(len(planes), dtype=np.int64), np.empty(len(planes))
    points = np.asfortranarray(points)  # by coordinate: a row of heights a plane
    for some in blocks(len(planes), HEIGHTS_AT_ONCE // len(points)):
        above = coordinates_along(points, planes[some, :3]) + planes[some, 3:]
        rows[some], heights[some] = above.argmax(axis=1), above.max(axis=1)
    return rows, heights


def _tetrahedron(points: FloatArray) -> list[int]:
    """Return the rows of four points far apart, the corners of a tetrahedron."""
    rows = [int(np.linalg.norm(points - points.mean(axis=0), axis=1).argmax())]
    offsets = points - points[rows[0]]
    for _ in range(3):
        lengths = np.linalg.norm(offsets, axis=1)
        rows.append(int(lengths.argmax()))
        direction = offsets[rows[-1]] / lengths.max()
        offsets = offsets - coordinates_along(direction[None], offsets) * direction
    return rows
