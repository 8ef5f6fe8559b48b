"""Polyhedra of collision shapes: coarse ones to show, and fine ones to measure."""

from __future__ import annotations

from itertools import product

import numpy as np

from ..geometry.directions import sphere_directions
from ..geometry.frames import area_vectors, coordinates_along
from ..geometry.primitives import CollisionShape, Hull
from ..steps.arrays import FloatArray, IntArray
from .convex_hull import convex_hull

# Corners of a side of a box, counter-clockwise.
_AROUND_SIDE = ((-1, -1), (1, -1), (1, 1), (-1, 1))
# Number of vertices around a cylinder when it is shown as a polyhedron.
_AROUND = 24
# Number of vertices on a sphere, or on both round ends of a capsule.
_ON_SPHERE = 162
# Vertices around a fine outline, and along each quarter of a circle from end to end.
_FINE_AROUND = 64
_FINE_QUARTER = 16


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
        ball = shape.sizes[0] * sphere_directions(_ON_SPHERE)
        upper, lower = ball[ball[:, 2] >= 0], ball[ball[:, 2] <= 0]
        local = np.concatenate([ends[0] + upper, ends[1] + lower])
    points = coordinates_along(shape.axes.T, local) + shape.center
    return convex_hull(points, float(shape.sizes.max()) / 1e3)


def faces_of(shape: CollisionShape) -> tuple[FloatArray, IntArray]:
    """Return the vertices and faces of a shape to be shown: six quads for a box.

    Parameters
    ----------
    shape : CollisionShape

    Returns
    -------
    vertices : (V, 3) float
    faces : (F, 4) int for a box, (F, 3) int for others
        Counter-clockwise seen from outside.
    """
    outline = outline_of(shape)
    if shape.kind != "BOX":
        return outline.vertices, outline.triangles
    sides = np.sign((outline.vertices - shape.center) @ shape.axes.T).astype(int)
    places = {tuple(side): row for row, side in enumerate(sides.tolist())}
    faces = []
    for axis, sign in product(range(3), (-1, 1)):
        # Around an axis, counter-clockwise from its end, in the order of the axes.
        rim = [np.roll((sign, u, v), axis) for u, v in _AROUND_SIDE[::sign]]
        faces.append([places[tuple(corner.tolist())] for corner in rim])
    return outline.vertices, np.array(faces)


def fine_outline(shape: CollisionShape) -> tuple[FloatArray, float]:
    """Return triangles near the surface of a collision shape, and how near.

    Parameters
    ----------
    shape : CollisionShape

    Returns
    -------
    corners : (F, 3, 3) float
        Exact for hulls and boxes. Vertices of others lie on the round surface.
    gap : float
        No point of the round surface is farther from the triangles.
    """
    if shape.kind in ("HULL", "BOX"):
        return outline_of(shape).corners, 0.0
    radius, _, half = shape.sizes
    heights, radii, step = np.array([-half, half]), np.full(2, radius), 0.0
    if shape.kind != "CYLINDER":
        step = np.pi / 2 / _FINE_QUARTER
        turns = step * np.arange(1, _FINE_QUARTER)
        radii = radius * np.r_[np.sin(turns), 1.0, 1.0, np.sin(turns)[::-1]]
        ends = half + radius * np.cos(turns)
        heights = np.r_[-ends, -half, half, ends[::-1]]
    tip = half if shape.kind == "CYLINDER" else half + radius
    heights, radii = np.r_[-tip, heights, tip], np.r_[0.0, radii, 0.0]
    turns = 2 * np.pi * np.arange(_FINE_AROUND + 1) / _FINE_AROUND
    circle = np.stack([np.cos(turns), np.sin(turns)])
    rings = np.empty((len(radii), len(turns), 3))
    rings[..., :2] = (radii[:, None, None] * circle).transpose(0, 2, 1)
    rings[..., 2] = heights[:, None]
    rings = coordinates_along(shape.axes.T, rings) + shape.center
    a, b, c, d = rings[:-1, :-1], rings[:-1, 1:], rings[1:, 1:], rings[1:, :-1]
    corners = np.stack([np.stack([a, b, c], 2), np.stack([a, c, d], 2)])
    corners = corners.reshape(-1, 3, 3)
    corners = corners[np.linalg.norm(area_vectors(corners), axis=1) > 0]
    around = 1 - np.cos(np.pi / _FINE_AROUND)
    return corners, float(radius * (around + 1 - np.cos(step / 2)))
