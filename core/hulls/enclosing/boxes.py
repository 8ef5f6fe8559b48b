"""Find the smallest boxes around convex hulls."""

from __future__ import annotations

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from ...geometry.frames import (
    area_vectors,
    coordinates_along,
    cross,
    distinct_directions,
    frame_of,
    frames,
    principal_axes,
)
from ...geometry.primitives import CollisionShape, Hull
from ...steps.arrays import FloatArray
from ...steps.rows import blocks

# Number of faces that a box may be flush with, the largest ones; and while cuts are
# compared.
_MOST_FACES, _FEW_FACES = 500, 4
# Largest number of vertices by which sizes of boxes are bounded.
_MOST_VERTICES = 500
# Decimal digits to which volumes and areas are compared; the longest side is 2.
DIGITS = 9
_EQUAL = 10**-DIGITS
# The same for the normals of parallel faces.
_NORMAL_DIGITS = 4
# Number of angles at which rectangles are looked at, to bound their areas, and of
# coordinates that are held at once for that.
_TURNS = 24
_AT_ONCE = 1_000_000


def box_around(hull: Hull) -> CollisionShape:
    """Return the smallest box that has one side flush with a large face of a hull.

    The smallest box of all has two adjacent sides that each contain an edge of the hull
    (O'Rourke 1985). Boxes flush with a face are nearly as small and far fewer.

    Parameters
    ----------
    hull : Hull

    Returns
    -------
    CollisionShape
    """
    return _smallest_box(hull, _normals_of_largest(hull, _MOST_FACES))


def rough_box(hull: Hull) -> CollisionShape:
    """Return a box flush with one of the largest faces, or along principal axes.

    Parameters
    ----------
    hull : Hull

    Returns
    -------
    CollisionShape
    """
    largest, axes = _normals_of_largest(hull, _FEW_FACES), principal_axes(hull.vertices)
    return _smallest_box(hull, np.concatenate([largest, axes]))


def _smallest_box(hull: Hull, normals: FloatArray) -> CollisionShape:
    """Return the smallest of the boxes that have a side with one of the normals.

    Few of them are made: lower bounds of their volumes rule the others out. Equal ones
    are told apart by the order of the normals.
    """
    normals, _ = distinct_directions(normals, _NORMAL_DIGITS)
    some = hull.vertices[:: -(-len(hull.vertices) // _MOST_VERTICES)]
    heights = np.ptp(some @ normals.T, axis=0)
    least = heights * _least_areas(some, normals)
    best, smallest = None, (np.inf, 0)
    for row in np.argsort(least, kind="stable"):
        if least[row] > smallest[0] + _EQUAL:
            break
        axes = _rectangle_axes(hull.vertices, normals[row])
        local = coordinates_along(axes, hull.vertices)
        low, high = local.min(axis=0), local.max(axis=0)
        center = coordinates_along(axes.T, (low + high) / 2)
        shape = CollisionShape("BOX", hull, center, axes, (high - low) / 2)
        if (volume := (round(shape.volume, DIGITS), row)) < smallest:
            best, smallest = shape, volume
    assert best is not None  # a hull has faces
    return best


def _normals_of_largest(hull: Hull, n_faces: int) -> FloatArray:
    """Return the normals of the largest faces of a hull, in its order, (N, 3)."""
    areas = np.linalg.norm(area_vectors(hull.corners), axis=1)
    largest = np.argsort(-np.round(areas, DIGITS), kind="stable")[:n_faces]
    return hull.planes[np.sort(largest), :3]


def _least_areas(points: FloatArray, normals: FloatArray) -> FloatArray:
    """Return lower bounds of the areas of rectangles around points along normals, (N,).

    The widths at some angles are exact. The two points that are farthest apart at one
    of them bound the widths at angles near by: no rectangle leaves them out. The least
    product of both widths is at one end of these angles.
    """
    near = np.pi / 4 / _TURNS
    turns = near * (1 + 2 * np.arange(_TURNS))
    least = np.empty(len(normals))
    for rows in blocks(len(normals), _AT_ONCE // (2 * _TURNS * len(points))):
        tangents, bitangents = np.stack(frames(normals[rows]))[:, :, None]
        cos, sin = np.cos(turns)[:, None], np.sin(turns)[:, None]
        axes = np.stack(
            [cos * tangents + sin * bitangents, cos * bitangents - sin * tangents]
        )
        heights = axes @ points.T
        spans = points[heights.argmax(axis=3)] - points[heights.argmin(axis=3)]
        widths = np.cos(near) * np.einsum("swtx,swtx->swt", spans, axes)
        change = np.sin(near) * np.einsum("swtx,swtx->swt", spans, axes[::-1])
        change[1] *= -1
        ends = np.maximum(np.stack([widths - change, widths + change]), 0.0)
        least[rows] = ends.prod(axis=1).min(axis=(0, 2))
    return least


def _rectangle_axes(points: FloatArray, normal: FloatArray) -> FloatArray:
    """Return the axes of the box of least base area, the last one `normal`, (3, 3)."""
    frame = frame_of(normal)
    flat = coordinates_along(frame[:2], points)
    try:
        outline = flat[ConvexHull(flat).vertices]
    except QhullError:  # seen edge on
        return frame
    edges = np.roll(outline, -1, axis=0) - outline
    edges /= np.linalg.norm(edges, axis=1, keepdims=True)
    along = edges @ outline.T
    across = np.stack([-edges[:, 1], edges[:, 0]], axis=1) @ outline.T
    areas = np.round(np.ptp(along, axis=1) * np.ptp(across, axis=1), DIGITS)
    right, up = edges[areas.argmin()]
    first = right * frame[0] + up * frame[1]
    return np.stack([first, cross(frame[2], first), frame[2]])
