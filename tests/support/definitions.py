"""What the core computes quickly, as it is defined: to compare the two."""

import numpy as np
from scipy.optimize import linear_sum_assignment


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
    assert abs(volume - hull.volume) <= 1e-6 * hull.volume
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


def tables(pairs):
    """Return which pairs of samples are visible and known, as plain arrays."""
    if pairs.known is None:
        return pairs.visible.astype(float), np.ones(pairs.visible.shape)
    return pairs.visible.toarray().astype(float), pairs.known.toarray().astype(float)


def psi(pairs, labels, alpha):
    """Return psi of labels of samples, equation 5."""
    visible, known = tables(pairs)
    same = labels[:, None] == labels
    hidden = known - visible
    return (visible[same].sum() + alpha * hidden[~same].sum()) / known.sum()


def agreement(labels, others, areas):
    """Return the share of the area on which two partitions agree at best."""
    shared = np.zeros((labels.max() + 1, others.max() + 1))
    np.add.at(shared, (labels, others), areas)
    return shared[linear_sum_assignment(-shared)].sum() / areas.sum()
