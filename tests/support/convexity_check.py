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
