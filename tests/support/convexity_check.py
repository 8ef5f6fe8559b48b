"""Whether a polyhedron is convex, told by its triangles alone."""

import numpy as np
import pytest


def assert_convex(hull, grain=1e-14):
    """Check that all vertices are behind all faces, and that these face out.

    `grain` is the precision of the coordinates: faces so thin that it turns them do not
    count.
    """
    corners = hull.vertices[hull.triangles]
    a, b, c = np.moveaxis(corners, 1, 0)
    normals = np.cross(b - a, c - a)
    doubled = np.linalg.norm(normals, axis=1)
    size = np.ptp(hull.vertices, axis=0).max()
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    firm = doubled > np.sqrt(grain) * size * longest
    normals = normals[firm] / doubled[firm, None]
    heights = np.einsum("fd,fvd->fv", normals, hull.vertices[None] - a[firm][:, None])
    assert firm.any()
    assert heights.max() < 4 * np.sqrt(grain) * size
    volume = np.einsum("fd,fd->f", a, np.cross(b, c)).sum() / 6
    assert volume == pytest.approx(hull.volume, rel=1e-6)
    assert volume > 0


def heights_above_shape(shape, points):
    """Return the heights of points above a collision shape, negative inside."""
    if shape.kind == "HULL":
        return shape.hull.heights(points)
    local = (points - shape.center) @ shape.axes.T
    if shape.kind == "BOX":
        return (np.abs(local) - shape.sizes).max(axis=1)
    radius, _, half = shape.sizes
    if shape.kind == "CYLINDER":
        around = np.hypot(local[:, 0], local[:, 1]) - radius
        return np.maximum(around, np.abs(local[:, 2]) - half)
    local[:, 2] -= np.clip(local[:, 2], -half, half)
    return np.linalg.norm(local, axis=1) - radius


def covered(shapes, points):
    """Return which points are in one of some collision shapes, or next to it, (M,)."""
    heights = [heights_above_shape(shape, points) for shape in shapes]
    return np.min(heights, axis=0) < 1e-3
