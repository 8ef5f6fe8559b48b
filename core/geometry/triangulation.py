"""Triangulation of polygons."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

# A triangle of less area, in squared diagonals of its polygon's bounding box, counts
# as flat.
_FLAT = 1e-12


# Shapes too large to compute with, or infinite, are refused later, in a sentence.
@np.errstate(over="ignore", invalid="ignore")
def triangulate(
    vertices: NDArray[np.float64], faces: Sequence[NDArray[np.int64]]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Cut polygons into triangles that keep their winding.

    A polygon becomes a fan around its first corner where no triangle folds over. If all
    fans fold, its ears are clipped one by one.

    Parameters
    ----------
    vertices : (V, 3) float
    faces : sequence of (N,) int
        Rows of `vertices` around each polygon, at least three.

    Returns
    -------
    triangles : (T, 3) int
        Rows of `vertices`, in the order of the polygons.
    polygons : (T,) int
        Polygon of each triangle.
    """
    sizes = np.array([len(face) for face in faces], dtype=np.int64)
    triangles = np.empty((int((sizes - 2).sum()), 3), dtype=np.int64)
    begins = np.cumsum(sizes - 2) - (sizes - 2)
    for size in np.unique(sizes):
        rows = np.flatnonzero(sizes == size)
        places = begins[rows, None] + np.arange(size - 2)
        corners = np.stack([faces[row] for row in rows.tolist()])
        triangles[places] = _triangulate_alike(vertices, corners)
    return triangles, np.repeat(np.arange(len(sizes)), sizes - 2)


def _triangulate_alike(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return the triangles (F, N - 2, 3) of polygons (F, N) of one size."""
    size = faces.shape[1]
    if size == 3:
        return faces[:, None]
    fan = np.array([(0, i, i + 1) for i in range(1, size - 1)])
    triangles = faces[:, fan]
    open_rows = np.arange(len(faces))
    for start in range(size):
        tried = faces[open_rows][:, (fan + start) % size]
        areas, _ = _signed_areas(vertices, faces[open_rows], tried)
        fits = (areas >= 0).all(axis=1)
        triangles[open_rows[fits]] = tried[fits]
        open_rows = open_rows[~fits]
        if len(open_rows) == 0:
            break
    for row in open_rows:
        triangles[row] = _cut_ears(vertices, faces[row])
    return triangles


def _signed_areas(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int64],
    triangles: NDArray[np.int64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the areas (F, T) of triangles, and unit normals (F, 3) of their polygons.

    An area is negative if the triangle faces against its polygon, and 0 if it is flat.
    """
    places = vertices[faces]
    places = places - places.mean(axis=1, keepdims=True)
    # Newell's normal, twice the area of the polygon long, convex or not.
    normals = np.cross(places, np.roll(places, -1, axis=1)).sum(axis=1)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    units = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    a, b, c = np.moveaxis(vertices[triangles], 2, 0)
    areas = np.einsum("ftx,fx->ft", np.cross(b - a, c - a), units)
    flat = _FLAT * np.square(np.ptp(places, axis=1)).sum(axis=1)
    areas[np.abs(areas) <= flat[:, None]] = 0.0
    return areas, units


def _cut_ears(
    vertices: NDArray[np.float64], face: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return the triangles (N - 2, 3) of a polygon whose fans all fold.

    Ear clipping (Meisters, "Polygons have ears", 1975). Where a polygon that crosses
    itself has no ear, its next corner is cut off.
    """
    left = list(range(len(face)))
    found = []
    while len(left) > 3:
        corners = np.array([np.roll(left, 1), left, np.roll(left, -1)]).T
        areas, normal = _signed_areas(vertices, face[None], face[corners][None])
        ears = (
            place
            for place in np.flatnonzero(areas[0] >= 0)
            if not _holds_any(vertices[face], corners[place], left, normal[0])
        )
        ear = int(next(ears, 0))
        found.append(corners[ear])
        del left[ear]
    found.append(np.array(left))
    triangles: NDArray[np.int64] = face[np.array(found)]
    return triangles


def _holds_any(
    places: NDArray[np.float64],
    triangle: NDArray[np.int64],
    corners: list[int],
    normal: NDArray[np.float64],
) -> bool:
    """Return whether another corner of the polygon lies in a triangle.

    Corners at the same place as its own do not count: edges to holes have two of each.
    """
    starts, others = places[triangle], places[corners]
    others = others[~(others[:, None] == starts).all(axis=2).any(axis=1)]
    along = np.roll(starts, -1, axis=0) - starts
    sides = np.cross(along, others[:, None] - starts) @ normal
    return bool((sides >= 0).all(axis=1).any())
