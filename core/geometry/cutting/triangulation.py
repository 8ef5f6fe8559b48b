"""Triangulation of polygons."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...steps.arrays import BoolArray, FloatArray, IntArray
from ..frames import area_vectors, cross

# A triangle of less area, in squared diagonals of its polygon's bounding box, counts
# as flat.
_FLAT = 1e-12
# Triangles, about, of a large fan that are looked at first.
_FEW = 32


# Shapes too large to compute with, or infinite, are refused later, in a sentence.
@np.errstate(over="ignore", invalid="ignore")
def triangulate(
    vertices: FloatArray, faces: Sequence[IntArray]
) -> tuple[IntArray, IntArray]:
    """Cut polygons into triangles that keep their winding.

    A quad is cut between its first and third corner, unless it folds over that line. A
    larger polygon becomes a fan around its first corner where no triangle folds over.
    If all fans fold, its ears are clipped one by one.

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
        cut = {3: _as_they_are, 4: _cut_quads}.get(size, _cut_alike)
        triangles[places] = cut(vertices, corners)
    return triangles, np.repeat(np.arange(len(sizes)), sizes - 2)


def _as_they_are(_: FloatArray, faces: IntArray) -> IntArray:
    """Return triangles (F, 3) as triangles (F, 1, 3)."""
    return faces[:, None]


def _cut_alike(vertices: FloatArray, faces: IntArray) -> IntArray:
    """Return the triangles (F, N - 2, 3) of polygons (F, N) of one size."""
    size = faces.shape[1]
    fan = np.array([(0, i, i + 1) for i in range(1, size - 1)])
    triangles = faces[:, fan]
    planes = _Planes.of(vertices, faces)
    # A few triangles show already that most fans fold. They are an odd number apart:
    # every second side of a comb runs the same way.
    few = fan[:: size // _FEW | 1]
    trials = (few, fan) if len(few) < len(fan) else (fan,)
    is_open = np.ones(len(faces), dtype=bool)
    for start in range(size):
        rows = np.flatnonzero(is_open)
        for some in trials:
            if len(rows):
                tried = faces[rows[:, None, None], (some + start) % size]
                areas = planes.signed_areas(vertices[tried], rows)
                fits = (areas >= 0).all(axis=1)
                rows, tried = rows[fits], tried[fits]
        if len(rows):
            triangles[rows], is_open[rows] = tried, False
            if not is_open.any():
                break
    for row in np.flatnonzero(is_open):
        triangles[row] = _cut_ears(vertices[faces[row]], faces[row], planes.only(row))
    return triangles


def _cut_quads(vertices: FloatArray, faces: IntArray) -> IntArray:
    """Return the triangles (F, 2, 3) of quads (F, 4)."""
    triangles = faces[:, [(0, 1, 2), (0, 2, 3)]]
    folded = are_folded(vertices[faces.T])
    triangles[folded] = faces[folded][:, [(0, 1, 3), (1, 2, 3)]]
    return triangles


def are_folded(quads: FloatArray) -> BoolArray:
    """Return which quads fold over the line from first to third corner.

    Their two triangles would face away from each other.

    Parameters
    ----------
    quads : (4, Q, 3) float

    Returns
    -------
    (Q,) bool
    """
    two, across, four = (np.ascontiguousarray(each.T) for each in quads[1:] - quads[0])
    (ax, ay, az), (bx, by, bz) = _cross(two, across), _cross(across, four)
    return ax * bx + ay * by + az * bz < 0


def _cross(one: FloatArray, other: FloatArray) -> tuple[FloatArray, ...]:
    """Return the three columns of the cross products of vectors, both (3, Q)."""
    (ax, ay, az), (bx, by, bz) = one, other
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


class _Planes(NamedTuple):
    """The planes of F polygons."""

    normals: FloatArray  # (F, 3), unit vectors or 0
    flat: FloatArray  # (F,), triangles of no more area count as flat

    @classmethod
    def of(cls, vertices: FloatArray, faces: IntArray) -> _Planes:
        """Return the planes of polygons (F, N) of one size."""
        places = vertices[faces]
        places = places - places.mean(axis=1, keepdims=True)
        # Newell's normal, twice the area of the polygon long, convex or not.
        normals = cross(places, np.roll(places, -1, axis=1)).sum(axis=1)
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        units = np.divide(normals, lengths, np.zeros_like(normals), where=lengths > 0)
        return cls(units, _FLAT * np.square(np.ptp(places, axis=1)).sum(axis=1))

    def only(self, row: int) -> _Planes:
        """Return the plane of one polygon."""
        return _Planes(self.normals[row : row + 1], self.flat[row : row + 1])

    def signed_areas(self, corners: FloatArray, rows: IntArray | slice) -> FloatArray:
        """Return the areas (R, T) of triangles (R, T, 3, 3) of R of the polygons.

        An area is negative if the triangle faces against its polygon, 0 if it is flat.
        """
        areas = np.einsum("ftx,fx->ft", area_vectors(corners), self.normals[rows])
        areas[np.abs(areas) <= self.flat[rows, None]] = 0.0
        return areas


def _cut_ears(places: FloatArray, face: IntArray, plane: _Planes) -> IntArray:
    """Return the triangles (N - 2, 3) of a polygon whose fans all fold.

    Ear clipping (Meisters, "Polygons have ears", 1975). Where a polygon that crosses
    itself has no ear, its next corner is cut off.
    """
    outline = _Outline(places, plane)
    found = [outline.cut_off(outline.first_ear()) for _ in range(len(face) - 3)]
    found.append(np.flatnonzero(outline.left))
    return face[np.array(found)]


class _Outline:
    """A polygon of N corners, from which ears are cut off one by one.

    What is known of a corner is kept until it may change: whether its triangle folds,
    until a neighbor is cut off, and a corner within it, until that one is cut off.

    Attributes
    ----------
    left : (N,) bool
        The corners that are left.
    """

    def __init__(self, places: FloatArray, plane: _Planes) -> None:
        self._places, self._plane = places, plane
        self._columns = np.ascontiguousarray((places - places[0]).T)
        corners = np.arange(len(places))
        # Each corner with the two beside it that are left.
        self._triangles = np.stack([corners - 1, corners, corners + 1], axis=1)
        self._triangles %= len(places)
        self.left = np.ones(len(places), dtype=bool)
        # Those whose triangle does not fold, and of these the ones that may be ears.
        self._upright, self._likely = np.zeros((2, len(places)), dtype=bool)
        self._changed = corners
        self._holding: defaultdict[int, list[int]] = defaultdict(list)

    def first_ear(self) -> int:
        """Return the first ear, or the first corner if there is none."""
        triangles = self._places[self._triangles[self._changed]]
        upright = self._plane.signed_areas(triangles[None], slice(None))[0] >= 0
        self._upright[self._changed] = self._likely[self._changed] = upright
        while self._likely.any():
            corner = int(self._likely.argmax())
            held = self._first_within(self._triangles[corner])
            if held is None:
                return corner
            self._likely[corner] = False
            self._holding[held].append(corner)
        return int(self.left.argmax())

    def cut_off(self, corner: int) -> IntArray:
        """Cut off a corner, and return its triangle (3,)."""
        triangle = self._triangles[corner]
        before, _, after = triangle
        self._triangles[before, 2], self._triangles[after, 0] = after, before
        self.left[corner] = self._upright[corner] = self._likely[corner] = False
        freed = self._holding.pop(corner, [])
        self._likely[freed] = self._upright[freed]
        self._changed = triangle[::2]
        return triangle

    def _first_within(self, triangle: IntArray) -> int | None:
        """Return the first corner that lies in a triangle of others, None if none does.

        Those on its sides do, but for rounding: a cut through a corner may leave a
        polygon without ears. Corners at the same place as its own do not count: edges
        to holes have two of each.
        """
        starts, normal = self._places[triangle], self._plane.normals[0]
        outwards = cross(starts[[1, 2, 0]] - starts, np.broadcast_to(normal, (3, 3)))
        limits = (outwards * self._columns.T[triangle]).sum(axis=1) + self._plane.flat
        outside = (outwards @ self._columns > limits[:, None]).any(axis=0)
        near = np.flatnonzero(self.left & ~outside)
        same = (self._places[near][:, None] == starts).all(axis=2).any(axis=1)
        return next(iter(near[~same].tolist()), None)
