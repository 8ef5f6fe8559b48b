"""What is inside a solid: single points, and how much of a collision shape is not."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...geometry.primitives import CollisionShape
from .fragments import fragments_of
from .holes import HoleEdges
from .shape_chords import chord_in

# Axes of the lines, turned so that they run along no edge and no face of most models.
# They are part of what is meant by the inside of an open mesh.
AXES = np.linalg.qr(np.array([[4.0, 1.3, 0.7], [-1.1, 3.9, 1.7], [0.6, -1.9, 4.3]]))[0]
AXES *= np.sign(np.linalg.det(AXES))
# Number of cells of the table of triangles along each side.
_CELLS = 96
# Lines through a collision shape along the longer side of its bounding box.
_LINES = 40
# Longest edge of the triangles in the table.
_COARSE = 0.3
# Factor by which volumes are raised, for what lies between the lines: it raises the
# radius of a ball by a fiftieth.
_SURELY = 1.06
# Patches smaller than this radius count as outside where the edge of a hole makes rays
# differ: what some of them call outside may be as thin as can be.
_NARROW = 0.001


class InsideTest:
    """Tells by lines along three axes what is inside a solid.

    A ray says that a point is inside if it leaves more triangles than it enters. Where
    a mesh is open, rays differ. The share of all rays that say so is about the winding
    number; of six rays, most decide.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of the triangles, counter-clockwise seen from outside.
    n_axes : int
        Number of axes to ask about points: 1 if the mesh is closed, else 3.
    """

    def __init__(self, corners: NDArray[np.float64], n_axes: int) -> None:
        self._n_axes = n_axes
        self._corners = corners @ AXES.T
        corners = fragments_of(self._corners, _COARSE)[0]
        self._low = corners.min(axis=(0, 1))
        self._step = np.ptp(corners, axis=(0, 1)).max() / _CELLS or 1.0
        self._slopes = [_slopes_of(corners, axis) for axis in range(3)]
        self._tables = [self._table(corners, axis) for axis in range(3)]

    @cached_property
    def _hole_edges(self) -> HoleEdges:
        """The edges of holes, in the coordinates of the lines."""
        return HoleEdges(self._corners)

    def holds(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return which points are inside, by most rays along the axes, both ways.

        Parameters
        ----------
        points : (M, 3) float

        Returns
        -------
        (M,) bool
        """
        local = points @ AXES.T
        votes = np.zeros(len(points), dtype=np.int64)
        for axis in range(self._n_axes):
            for leaving in self._leaving(axis, local):
                votes += leaving > 0
        return votes > self._n_axes

    def holds_patches(
        self, centers: NDArray[np.float64], radii: NDArray[np.float64], largest: float
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Return which patches have centers inside, and no way out but the surface.

        Parameters
        ----------
        centers : (M, 3) float
        radii : (M,) float
            No point of a patch is farther from its center.
        largest : float
            Larger patches are not looked at for ways out.

        Returns
        -------
        inside : (M,) bool
            Whether the center is inside; not of small patches beside holes.
        whole : (M,) bool
            Of those, whether surely nothing but the surface leads outside.
        """
        local, small = centers @ AXES.T, radii <= largest
        leaving = np.array([[*self._leaving(k, local)] for k in range(self._n_axes)])
        inside = (leaving > 0).sum(axis=(0, 1)) > self._n_axes
        if self._n_axes == 1:  # nothing but the surface is between inside and outside
            return inside, inside & small
        whole, rows = inside & small, np.flatnonzero(inside & small)
        whole[rows] = self._hole_edges.surely_inside(
            local[rows], radii[rows], leaving[..., rows]
        )
        return inside & (whole | (radii > min(_NARROW, largest))), whole

    def volume_outside(self, shape: CollisionShape) -> float:
        """Return the volume of a collision shape that is outside.

        Parameters
        ----------
        shape : CollisionShape

        Returns
        -------
        float
            The largest of the estimates along three axes, and a little more.
        """
        low, high = _turned(shape).bounds
        step = (high - low).max() / _LINES
        estimates = []
        for axis in range(3):
            sides = [(axis + 1) % 3, (axis + 2) % 3]
            across, up = (
                np.arange(low[s] + step / 2, high[s] + step / 2, step) for s in sides
            )
            spots = np.stack(np.meshgrid(across, up), axis=-1).reshape(-1, 2)
            origins = np.zeros((len(spots), 3))
            origins[:, sides] = spots
            enter, leave = chord_in(shape, origins @ AXES, AXES[axis])
            met = np.flatnonzero(leave > enter)
            enter, leave = enter[met], leave[met]
            inside = self._length_inside(axis, spots[met], enter, leave)
            estimates.append((leave - enter).sum() - inside)
        return float(max(*estimates, 0.0) * step**2) * _SURELY

    def _leaving(
        self, axis: int, local: NDArray[np.float64]
    ) -> Iterator[NDArray[np.int64]]:
        """Yield how many more triangles rays leave than enter, either way, (M,).

        The first rays run against the axis, the others along it.
        """
        sides = [(axis + 1) % 3, (axis + 2) % 3]
        line, heights, turns = self._crossings(axis, local[:, sides])
        below = heights < local[line, axis]
        for some, side in ((below, 1), (~below, -1)):
            counts = np.bincount(line[some], side * turns[some], len(local))
            yield counts.astype(np.int64)

    def _length_inside(
        self,
        axis: int,
        spots: NDArray[np.float64],
        enter: NDArray[np.float64],
        leave: NDArray[np.float64],
    ) -> float:
        """Return the length of segments of lines along an axis that is inside."""
        line, heights, turns = self._crossings(axis, spots)
        order = np.lexsort((heights, line))
        line, heights, turns = line[order], heights[order], turns[order]
        first = np.r_[True, line[1:] != line[:-1]][: len(line)]
        starts = np.maximum.accumulate(np.where(first, np.arange(len(line)), 0))
        total = np.cumsum(turns)
        depths = total - (total - turns)[starts]
        # Counted from the end of the line, too: in an open mesh the two may differ.
        leftover = np.bincount(line, turns, len(spots))[line]
        within = (depths > 0) & (depths > leftover)
        inside = np.flatnonzero(within[:-1] & ~first[1:])
        rows = line[inside]
        start = np.maximum(heights[inside], enter[rows])
        end = np.minimum(heights[inside + 1], leave[rows])
        return float(np.maximum(end - start, 0.0).sum())

    def _table(
        self, corners: NDArray[np.float64], axis: int
    ) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return the triangles over each cell of a grid, and where they start."""
        sides = [(axis + 1) % 3, (axis + 2) % 3]
        flat = (corners[:, :, sides] - self._low[sides]) / self._step
        low, high = (
            np.clip(ends.astype(np.int64), 0, _CELLS - 1)
            for ends in (flat.min(axis=1), flat.max(axis=1))
        )
        widths = high - low + 1
        faces_lines = self._slopes[axis][-1] != 0
        counts = np.where(faces_lines, widths.prod(axis=1), 0)
        triangle = np.repeat(np.arange(len(flat)), counts)
        rank = np.arange(len(triangle)) - np.repeat(np.cumsum(counts) - counts, counts)
        column, row = np.divmod(rank, widths[triangle, 1])
        cell = (column + low[triangle, 0]) * _CELLS + row + low[triangle, 1]
        order = np.argsort(cell, kind="stable")
        starts = np.searchsorted(cell[order], np.arange(_CELLS**2 + 1))
        return triangle[order], starts

    def _crossings(
        self, axis: int, spots: NDArray[np.float64]
    ) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]:
        """Return line, height and turn of each crossing of lines with triangles."""
        triangles, starts = self._tables[axis]
        sides = [(axis + 1) % 3, (axis + 2) % 3]
        cells = np.floor((spots - self._low[sides]) / self._step).astype(np.int64)
        known = ((cells >= 0) & (cells < _CELLS)).all(axis=1)
        cell = np.where(known, cells[:, 0] * _CELLS + cells[:, 1], 0)
        counts = np.where(known, starts[cell + 1] - starts[cell], 0)
        line = np.repeat(np.arange(len(spots)), counts)
        rank = np.arange(len(line)) - np.repeat(np.cumsum(counts) - counts, counts)
        triangle = triangles[starts[cell[line]] + rank]
        x0, y0, z0, bx, by, bz, cx, cy, cz, turns = self._slopes[axis]
        x, y = spots[line, 0] - x0[triangle], spots[line, 1] - y0[triangle]
        b = x * bx[triangle] + y * by[triangle]
        c = x * cx[triangle] + y * cy[triangle]
        hit = np.flatnonzero((b >= 0) & (c >= 0) & (b + c <= 1))
        triangle = triangle[hit]
        heights = z0[triangle] + b[hit] * bz[triangle] + c[hit] * cz[triangle]
        return line[hit], heights, turns[triangle].astype(np.int64)


def _slopes_of(corners: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
    """Return what tells where lines along an axis cross triangles, (10, T).

    Three rows have the first corner: x and y across the lines, z along them. Then three
    for each other corner: how much its share of a point grows along x and y, and its z
    above that of the first corner. The last row is 1 where a line along the axis
    enters the inside, −1 where it leaves it, 0 where it is in the plane.
    """
    a, b, c = np.moveaxis(corners[..., [(axis + 1) % 3, (axis + 2) % 3, axis]], 1, 0)
    a, b, c = a.T, (b - a).T, (c - a).T
    area = b[0] * c[1] - b[1] * c[0]
    faces = area != 0
    of_b = np.divide([c[1], -c[0]], area, out=np.zeros((2, len(area))), where=faces)
    of_c = np.divide([-b[1], b[0]], area, out=np.zeros((2, len(area))), where=faces)
    return np.concatenate([a, of_b, b[2:], of_c, c[2:], [-np.sign(area)]])


def _turned(shape: CollisionShape) -> CollisionShape:
    """Return a collision shape in the coordinates of the lines."""
    hull = replace(shape.hull, vertices=shape.hull.vertices @ AXES.T)
    center, axes = AXES @ shape.center, shape.axes @ AXES.T
    return replace(shape, hull=hull, center=center, axes=axes)
