"""Fit boxes, spheres, cylinders and capsules around convex hulls."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from ..geometry.frames import frames, principal_axes
from ..geometry.primitives import CollisionShape, Hull
from ..parameters.hulls import HullParameters
from .convex_hull import convex_hull, directions, offset, simplified
from .piece import THIN

# Rounds of the search for the smallest ball; its radius is then exact to a thousandth.
_ROUNDS = 1000
# Number of vertices around a cylinder when it is shown as a polyhedron.
_AROUND = 24
# Number of vertices on a sphere, or on both round ends of a capsule.
_ON_SPHERE = 162


def fit_shape(hull: Hull, parameters: HullParameters, unit: float) -> CollisionShape:
    """Fit the kind of shape that `parameters` ask for around a hull.

    Boxes, spheres, cylinders and capsules contain the hull. Simplified hulls contain
    it to a ten thousandth of the longest side, if `max_vertices` allows for it.

    Parameters
    ----------
    hull : Hull
        The longest side of the whole shape is 2.
    parameters : HullParameters
    unit : float
        Length of 1 in the units of the mesh, which the margin is given in.

    Returns
    -------
    CollisionShape
        In the space of `hull`.
    """
    margin = parameters.margin / unit
    if parameters.shape == "HULL":
        grown = simplified(offset(hull, margin), parameters.max_vertices, THIN / 10)
        return CollisionShape("HULL", grown, np.zeros(3), np.eye(3), np.zeros(3))
    shape = _FITS[parameters.shape](hull)
    least = np.where(shape.sizes > 0, THIN / 2, 0.0)
    moving = shape.sizes > 0
    moving[2] &= parameters.shape != "CAPSULE"  # its ends move with its radius
    return replace(shape, sizes=np.maximum(shape.sizes + margin * moving, least))


def box_around(hull: Hull) -> CollisionShape:
    """Return the smallest box that has one side flush with a face of a hull.

    The smallest box of all has two adjacent sides that each contain an edge of the hull
    (O'Rourke 1985). Boxes flush with a face are nearly as small and far fewer.

    Parameters
    ----------
    hull : Hull

    Returns
    -------
    CollisionShape
    """
    best: CollisionShape | None = None
    for normal in _normals(hull):
        axes = _rectangle_axes(hull.vertices, normal)
        local = hull.vertices @ axes.T
        low, high = local.min(axis=0), local.max(axis=0)
        shape = CollisionShape(
            "BOX", hull, (low + high) / 2 @ axes, axes, (high - low) / 2
        )
        if best is None or shape.volume < best.volume:
            best = shape
    assert best is not None  # a hull has faces
    return best


def sphere_around(hull: Hull) -> CollisionShape:
    """Return the smallest sphere around a hull, to a thousandth of its radius.

    Parameters
    ----------
    hull : Hull

    Returns
    -------
    CollisionShape
    """
    center, radius = _smallest_ball(hull.vertices)
    sizes = np.array([radius, radius, 0.0])
    return CollisionShape("SPHERE", hull, center, np.eye(3), sizes)


def cylinder_around(hull: Hull) -> CollisionShape:
    """Return the smallest of six cylinders around a hull.

    Parameters
    ----------
    hull : Hull
        The axes tried are those of its box and the principal axes of its vertices.

    Returns
    -------
    CollisionShape
    """
    return min((_cylinder(hull, axis) for axis in _axes(hull)), key=lambda s: s.volume)


def capsule_around(hull: Hull) -> CollisionShape:
    """Return the smallest of six capsules around a hull.

    Parameters
    ----------
    hull : Hull
        The axes tried are those of its box and the principal axes of its vertices.

    Returns
    -------
    CollisionShape
    """
    return min((_capsule(hull, axis) for axis in _axes(hull)), key=lambda s: s.volume)


_FITS = {
    "BOX": box_around,
    "SPHERE": sphere_around,
    "CYLINDER": cylinder_around,
    "CAPSULE": capsule_around,
}


def _cylinder(hull: Hull, axis: NDArray[np.float64]) -> CollisionShape:
    """Return the smallest cylinder along an axis."""
    frame = _frame(axis)
    local = hull.vertices @ frame.T
    center, radius = _smallest_ball(local[:, :2])
    low, high = local[:, 2].min(), local[:, 2].max()
    middle = np.r_[center, (low + high) / 2] @ frame
    sizes = np.array([radius, radius, (high - low) / 2])
    return CollisionShape("CYLINDER", hull, middle, frame, sizes)


def _capsule(hull: Hull, axis: NDArray[np.float64]) -> CollisionShape:
    """Return the shortest of the capsules with the least radius along an axis."""
    frame = _frame(axis)
    local = hull.vertices @ frame.T
    center, radius = _smallest_ball(local[:, :2])
    around = np.linalg.norm(local[:, :2] - center, axis=1)
    # Height of the round end above its base, at the distance of each vertex.
    room = np.sqrt(np.maximum(radius**2 - around**2, 0.0))
    low, high = (local[:, 2] + room).min(), (local[:, 2] - room).max()
    middle = np.r_[center, (low + high) / 2] @ frame
    sizes = np.array([radius, radius, max(high - low, 0.0) / 2])
    return CollisionShape("CAPSULE", hull, middle, frame, sizes)


def _axes(hull: Hull) -> NDArray[np.float64]:
    """Return the axes to try: those of the box and the principal axes, (6, 3)."""
    return np.concatenate([box_around(hull).axes, principal_axes(hull.vertices)])


def _normals(hull: Hull) -> NDArray[np.float64]:
    """Return the normals of a hull's faces, equal and opposite ones once, (N, 3)."""
    rounded = np.round(hull.planes[:, :3], 4)
    rounded *= np.sign(
        rounded[np.arange(len(rounded)), np.abs(rounded).argmax(axis=1)]
    )[:, None]
    _, rows = np.unique(rounded, axis=0, return_index=True)
    return hull.planes[np.sort(rows), :3]


def _rectangle_axes(
    points: NDArray[np.float64], normal: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the axes of the box of least base area, the last one `normal`, (3, 3)."""
    frame = _frame(normal)
    flat = points @ frame[:2].T
    try:
        outline = flat[ConvexHull(flat).vertices]
    except QhullError:  # seen edge on
        return frame
    edges = np.roll(outline, -1, axis=0) - outline
    edges /= np.linalg.norm(edges, axis=1, keepdims=True)
    along = edges @ outline.T
    across = np.stack([-edges[:, 1], edges[:, 0]], axis=1) @ outline.T
    edge = edges[(np.ptp(along, axis=1) * np.ptp(across, axis=1)).argmin()]
    first = edge @ frame[:2]
    return np.stack([first, np.cross(frame[2], first), frame[2]])


def _frame(axis: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return right-handed axes whose last row is `axis`, (3, 3)."""
    return np.concatenate([*frames(axis[None]), axis[None]])


def _smallest_ball(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
    """Return center and radius of nearly the smallest ball around points (N, 2 or 3).

    Bădoiu and Clarkson 2003, "Smaller core-sets for balls": the center moves towards
    the farthest point, by a smaller share of the way in each round.
    """
    center = points.mean(axis=0)
    for step in range(1, _ROUNDS + 1):
        away = points - center
        farthest = np.einsum("nd,nd->n", away, away).argmax()
        center = center + away[farthest] / (step + 1)
    return center, float(np.linalg.norm(points - center, axis=1).max())


def outline_of(shape: CollisionShape) -> Hull:
    """Return a collision shape as a polyhedron.

    Parameters
    ----------
    shape : CollisionShape

    Returns
    -------
    Hull
        Vertices of spheres, cylinders and capsules lie on the round surface, so the
        polyhedron is a little smaller than the shape.
    """
    if shape.kind == "HULL":
        return shape.hull
    ends = np.array([[0.0, 0.0, shape.sizes[2]], [0.0, 0.0, -shape.sizes[2]]])
    if shape.kind == "BOX":
        local = shape.sizes * (2.0 * np.indices((2, 2, 2)).reshape(3, -1).T - 1)
    elif shape.kind == "CYLINDER":
        turns = 2 * np.pi * np.arange(_AROUND) / _AROUND
        circle = np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1)
        local = (ends[:, None] + shape.sizes[0] * circle).reshape(-1, 3)
    else:
        ball = shape.sizes[0] * directions(_ON_SPHERE)
        upper, lower = ball[ball[:, 2] >= 0], ball[ball[:, 2] <= 0]
        local = np.concatenate([ends[0] + upper, ends[1] + lower])
    points = local @ shape.axes + shape.center
    return convex_hull(points, float(shape.sizes.max()) / 1e3)
