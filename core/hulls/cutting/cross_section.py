"""Cut a shape by a plane: find the contour and sample the cross-section inside it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.frames import coordinates_along, cross, frames, heights_above
from ...steps.arrays import BoolArray, FloatArray

# Distance between the sample points of a cross-section; the longest side is 2.
_GRAIN = 0.04
# Three planes meet in a point only if the determinant of their normals is above this.
_PARALLEL = 1e-4
# Height up to which a point counts as on a plane.
_ON_PLANE = 1e-9


def contour(corners: FloatArray, plane: FloatArray) -> FloatArray:
    """Return the segments in which a plane meets triangles.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of the triangles, counter-clockwise seen from outside.
    plane : (4,) float
        Unit normal n and offset d: n · x + d = 0 on the plane.

    Returns
    -------
    (S, 2, 3) float
        Start and end of each segment. The inside of the shape is on its left, seen
        from the side that n points to.
    """
    heights = heights_above(plane[None], corners)[..., 0]
    under = heights <= 0
    n_under = under.sum(axis=1)
    met = np.flatnonzero((n_under > 0) & (n_under < 3))
    # Rotate the corners of each triangle: the one alone on its side comes first.
    lone_under = n_under[met] == 1
    alone = np.where(lone_under[:, None], under[met], ~under[met])
    turn = (alone.argmax(axis=1)[:, None] + np.arange(3)) % 3
    rows = met[:, None]
    a, b, c = corners[rows, turn].swapaxes(0, 1)
    over = heights[rows, turn][..., None]
    ab = a + over[:, 0] / (over[:, 0] - over[:, 1]) * (b - a)
    ac = a + over[:, 0] / (over[:, 0] - over[:, 2]) * (c - a)
    ends = np.stack([ab, ac], axis=1)
    return np.where(lone_under[:, None, None], ends[:, ::-1], ends)


@dataclass(frozen=True, eq=False)
class Section:
    """The cross-section of a shape in a plane.

    Attributes
    ----------
    plane : (4,) float
        Unit normal n and offset d: n · x + d = 0 on the plane.
    axes : (2, 3) float
        Orthogonal unit vectors in the plane.
    rim : (S, 2, 3) float
        Segments of the contour.
    segments : (S, 2, 2) float
        The same segments in 2D, as coordinates along `axes`.
    """

    plane: FloatArray
    axes: FloatArray
    rim: FloatArray
    segments: FloatArray

    def spread(self, within: FloatArray) -> FloatArray:
        """Return the points of a square grid that are inside the cross-section.

        Parameters
        ----------
        within : (P, 3) float
            The grid covers the 2D bounding box of these points.

        Returns
        -------
        (M, 3) float
        """
        flat = coordinates_along(self.axes, within)
        steps = [
            np.arange(low + 0.39 * _GRAIN, high, _GRAIN)
            for low, high in zip(flat.min(axis=0), flat.max(axis=0), strict=True)
        ]
        columns, rows = np.nonzero(_is_inside(self.segments, *steps).T)
        across, up = steps[0][columns, None], steps[1][rows, None]
        (right, top), normal = self.axes, self.plane[:3]
        return across * right + up * top - self.plane[3] * normal

    def holds(self, points: FloatArray) -> BoolArray:
        """Return which points of the plane are inside the cross-section.

        Parameters
        ----------
        points : (M, 3) float

        Returns
        -------
        (M,) bool
            False where the contour is open on the point's line along the first axis,
            and where it runs clockwise: a dome seen from inside holds nothing.
        """
        across, up = coordinates_along(self.axes, points).T[..., None]
        (x0, y0), (x1, y1) = self.segments.transpose(1, 2, 0)
        turns = (y1 > up).astype(np.int64) - (y0 > up)
        rise = np.where(y1 == y0, 1.0, y1 - y0)
        before = x0 + (up - y0) / rise * (x1 - x0) <= across
        windings = (turns * before).sum(axis=1)
        return (windings < 0) & (turns.sum(axis=1) == 0)


def cross_section(corners: FloatArray, plane: FloatArray) -> Section:
    """Return the cross-section of a shape in a plane.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of its triangles, counter-clockwise seen from outside.
    plane : (4,) float
        Unit normal n and offset d: n · x + d = 0 on the plane.

    Returns
    -------
    Section
    """
    axes = np.concatenate(frames(plane[None, :3]))
    rim = contour(corners, plane)
    return Section(plane, axes, rim, coordinates_along(axes, rim))


def lines_of(planes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the lines in which two planes meet, by Plücker coordinates.

    Parameters
    ----------
    planes : (P, 4) float
        Unit normal n and offset d of each plane.

    Returns
    -------
    ways : (L, 3) float
        n × n' of each two planes, which is along the line.
    moments : (L, 3) float
        d n' − d' n, which is p × (n × n') for any point p of the line.
    """
    one, other = (planes[rows] for rows in np.triu_indices(len(planes), 1))
    moments = one[:, 3:] * other[:, :3] - other[:, 3:] * one[:, :3]
    return cross(one[:, :3], other[:, :3]), moments


def meeting_points(
    lines: tuple[FloatArray, FloatArray], planes: FloatArray, plane: FloatArray
) -> FloatArray:
    """Return the corners of a cell where a plane meets two others, (M, 3).

    Such corners may lie inside the solid, where no triangle has a vertex.

    Parameters
    ----------
    lines : two of (L, 3) float
        Those of the planes, see `lines_of`.
    planes : (P, 4) float
        Those of the cell: n · x + d ≤ 0 in it.
    plane : (4,) float
        The plane that cuts it.
    """
    ways, moments = lines
    falls = coordinates_along(plane[None, :3], ways)[:, 0]
    firm = np.abs(falls) > _PARALLEL
    ways, moments, falls = ways[firm], moments[firm], falls[firm, None]
    normals = np.broadcast_to(plane[:3], ways.shape)
    points = -(cross(moments, normals) + plane[3] * ways) / falls
    return points[(heights_above(planes, points) <= _ON_PLANE).all(axis=1)]


def _is_inside(segments: FloatArray, across: FloatArray, up: FloatArray) -> BoolArray:
    """Return which points of a grid are inside a 2D contour (S, 2, 2), (U, A)."""
    (x0, y0), (x1, y1) = segments.transpose(1, 2, 0)
    turns = (y1 > up[:, None]).astype(np.int64) - (y0 > up[:, None])
    rows, crossed = np.nonzero(turns)
    share = (up[rows] - y0[crossed]) / (y1 - y0)[crossed]
    columns = np.searchsorted(across, x0[crossed] + share * (x1 - x0)[crossed])
    windings = np.zeros((len(up), len(across) + 1), dtype=np.int64)
    np.add.at(windings, (rows, columns), turns[rows, crossed])
    windings = np.cumsum(windings, axis=1)
    # A row whose winding number does not return to 0 crosses an open contour; its
    # inside is not defined.
    return (windings[:, :-1] < 0) & (windings[:, -1:] == 0)
