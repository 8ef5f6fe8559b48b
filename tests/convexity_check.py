"""Whether a polyhedron is convex, told by its triangles alone."""

import numpy as np
import pytest


def assert_convex(hull):
    """Check a hull by its triangles alone: all vertices behind all faces."""
    a, b, c = np.moveaxis(hull.vertices[hull.triangles], 1, 0)
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    size = np.ptp(hull.vertices, axis=0).max()
    firm = lengths > 1e-9 * size**2
    normals = normals[firm] / lengths[firm, None]
    heights = np.einsum("fd,fvd->fv", normals, hull.vertices[None] - a[firm][:, None])
    assert heights.max() < 1e-6 * size
    # Facing out, too: the volume that the triangles enclose is positive.
    volume = np.einsum("fd,fd->f", a, np.cross(b, c)).sum() / 6
    assert volume == pytest.approx(hull.volume, rel=1e-6)
    assert hull.volume > 0
