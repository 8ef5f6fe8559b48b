"""Finds which part each piece of a cut face belongs to."""

from __future__ import annotations

import numpy as np

from ...steps.arrays import FloatArray, IntArray
from ...steps.rows import RowsByNumber
from ..frames import cross
from ..mesh import TriangleMesh
from .refined import RefinedMesh

# Labels that cover equal areas of a face, but for rounding.
_EQUAL = 1e-3
# A label that got less of the area it covers lost its place to others.
_LOST = 0.1


def labels_of_pieces(
    refined: RefinedMesh, labels: IntArray, cut: TriangleMesh, faces: IntArray
) -> tuple[IntArray, IntArray]:
    """Return the part that covers most of each piece of the faces.

    Parameters
    ----------
    refined : RefinedMesh
    labels : (Q,) int
        Part of each polygon of the refined mesh, in 0…K − 1.
    cut : TriangleMesh
        The mesh after its faces were cut, in the same units. Its polygons are pieces.
    faces : (P,) int
        The face that each piece is of.

    Returns
    -------
    of_pieces : (P,) int
    of_polygons : (Q,) int
        Part of the piece that each polygon of the refined mesh lies in.
    """
    centers, areas = refined.centers()
    polygons = RowsByNumber(refined.faces, int(faces.max()) + 1)
    piece = _pieces_at(centers, refined.faces, polygons, cut, faces)
    votes = np.zeros((len(faces), int(labels.max()) + 1))
    np.add.at(votes, (piece, labels), areas + np.finfo(float).tiny)
    found = votes.argmax(axis=1)
    # A sliver without a center gets the part of the piece that is nearest.
    middles = np.zeros((len(faces), 3))
    middles[cut.polygons] = cut.vertices[cut.triangles].mean(axis=1)
    for sliver in np.flatnonzero(~votes.any(axis=1)).tolist():
        there = polygons.of(faces[sliver])
        away = np.linalg.norm(centers[there] - middles[sliver], axis=1)
        found[sliver] = found[piece[there[away.argmin()]]]
    return found, found[piece]


def _pieces_at(
    points: FloatArray,
    faces_of_points: IntArray,
    points_of_faces: RowsByNumber,
    cut: TriangleMesh,
    faces: IntArray,
) -> IntArray:
    """Return the piece of its face that each point lies in."""
    triangles = RowsByNumber(faces[cut.polygons], int(faces.max()) + 1)
    single = np.bincount(faces) == 1
    one_piece = np.zeros(len(single), dtype=np.int64)
    one_piece[faces] = np.arange(len(faces))
    found = one_piece[faces_of_points]
    for face in np.unique(faces_of_points[~single[faces_of_points]]).tolist():
        rows, there = triangles.of(face), points_of_faces.of(face)
        inside = _insideness(points[there], cut.vertices[cut.triangles[rows]])
        found[there] = cut.polygons[rows[inside.argmax(axis=1)]]
    return found


def _insideness(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Return the least barycentric coordinate of points in triangles, (M, T).

    It is 0 or more inside; −inf for a triangle without area.
    """
    origin, one, other = np.moveaxis(corners, 1, 0)
    u, v = one - origin, other - origin
    normal = cross(u, v)
    squared = (normal**2).sum(axis=1)
    away = points[:, None] - origin
    with np.errstate(divide="ignore", invalid="ignore"):
        second = (cross(away, v) * normal).sum(axis=2) / squared
        third = (cross(away, -u) * normal).sum(axis=2) / squared
    least = np.minimum(np.minimum(second, third), 1 - second - third)
    return np.where(squared > 0, least, -np.inf)


def labels_by_area(
    labels: IntArray, origins: IntArray, areas: FloatArray
) -> tuple[IntArray, IntArray, IntArray]:
    """Return the label that covers most of each face, from labels of its fragments.

    Of labels that cover equal areas, the lowest counts. A label that so gets little of
    what it covers leaves it to others: it would stay as a few stray faces.

    Parameters
    ----------
    labels : (E,) int
        Labels of the fragments, from 0.
    origins : (E,) int
        The face that each fragment comes from.
    areas : (E,) float
        Of the fragments.

    Returns
    -------
    faces : (F,) int
        The faces with fragments, sorted.
    found : (F,) int
        Their labels.
    counts : (F,) int
        How many labels share each.
    """
    stride = int(labels.max()) + 1
    cells, places = np.unique(origins * stride + labels, return_inverse=True)
    rows, candidates = np.divmod(cells, stride)
    covered = np.bincount(places, areas).astype(np.float64)
    faces, starts, counts = np.unique(rows, return_index=True, return_counts=True)

    def largest(values: FloatArray) -> IntArray:
        """Return the first cell of the largest value of each face."""
        most = np.repeat(np.maximum.reduceat(values, starts), counts)
        best = np.flatnonzero(values >= (1 - _EQUAL) * most)
        return best[np.unique(rows[best], return_index=True)[1]]

    best = largest(covered)
    got = np.bincount(candidates[best], covered[best], stride)
    lost = got < _LOST * np.bincount(candidates, covered, stride)
    best = largest(np.where(lost[candidates], 0.0, covered))
    return faces, candidates[best], counts
