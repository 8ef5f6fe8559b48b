"""What is inside a solid: single points, and how much of a collision shape is not."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from ...geometry.frames import settled
from ...geometry.primitives import CollisionShape
from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.progress import Progress, Steps
from ...steps.rows import blocks
from .holes import HoleEdges
from .line_crossings import TURNS, LineCrossings, as_seen, in_order, line_crossings
from .shape_chords import chord_in

# Axes of the lines, turned so that they run along no edge and no face of most models.
# They are part of what is meant by the inside of an open mesh.
AXES = np.linalg.qr(np.array([[4.0, 1.3, 0.7], [-1.1, 3.9, 1.7], [0.6, -1.9, 4.3]]))[0]
AXES = settled(AXES * np.sign(np.linalg.det(AXES)))
# Points that are looked at in one step.
_AT_ONCE = 1_000
# Lines through a collision shape along the longer side of its bounding box.
_LINES = 40
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
    local : (T, 3, 3) float
        Corners of the triangles, in the coordinates of the lines.
    crossings : LineCrossings
        Of the same.
    n_axes : int
        Number of axes to ask about points.
    """

    def __init__(
        self, local: FloatArray, crossings: LineCrossings, n_axes: int
    ) -> None:
        self._n_axes = n_axes
        self._corners = local
        self._crossings = crossings

    @cached_property
    def _hole_edges(self) -> HoleEdges:
        """The edges of holes, in the coordinates of the lines."""
        return HoleEdges(self._corners)

    def holds(self, points: FloatArray) -> BoolArray:
        """Return which points are inside, by most rays along the axes, both ways.

        Parameters
        ----------
        points : (M, 3) float

        Returns
        -------
        (M,) bool
        """
        votes = (self._leaving(points @ AXES.T) > 0).sum(axis=(0, 1))
        return votes > self._n_axes

    def which_held(self, points: FloatArray) -> Steps[BoolArray]:
        """Return which of many points are inside, some at a time; see `holds`.

        Parameters
        ----------
        points : (M, 3) float

        Returns
        -------
        Steps of (M,) bool
        """
        inside = np.zeros(len(points), dtype=bool)
        for some in blocks(len(points), _AT_ONCE):
            yield Progress("Solid", some.start / len(points))
            inside[some] = self.holds(points[some])
        return inside

    def holds_patches(
        self, centers: FloatArray, radii: FloatArray, asked: BoolArray
    ) -> tuple[BoolArray, BoolArray]:
        """Return which patches have centers inside, and no way out but the surface.

        Parameters
        ----------
        centers : (M, 3) float
        radii : (M,) float
            No point of a patch is farther from its center.
        asked : (M,) bool
            Which patches are looked at for ways out.

        Returns
        -------
        inside : (M,) bool
            Whether the center is inside; not of small patches beside holes.
        whole : (M,) bool
            Of those, whether surely nothing but the surface leads outside.
        """
        local = centers @ AXES.T
        leaving = self._leaving(local)
        inside = (leaving > 0).sum(axis=(0, 1)) > self._n_axes
        if self._n_axes == 1:  # nothing but the surface is between inside and outside
            return inside, inside & asked
        whole, rows = inside & asked, np.flatnonzero(inside & asked)
        whole[rows] = self._hole_edges.surely_inside(
            local[rows], radii[rows], leaving[..., rows]
        )
        return inside & (whole | ~asked | (radii > _NARROW)), whole

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
            sides = TURNS[axis, :2]
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

    def _leaving(self, local: FloatArray) -> IntArray:
        """Return how many more triangles rays leave than enter, (axes, 2, M).

        Of each axis, the first rays run against it, the others along it.
        """
        n_axes, n = self._n_axes, len(local)
        turned = as_seen(local)[:n_axes].reshape(-1, 3)
        axes = np.repeat(np.arange(n_axes), n)
        line, heights, turns = self._crossings.of(axes, turned[:, :2])
        below = heights < turned[line, 2]
        leaving = [
            np.bincount(line[some], side * turns[some], n_axes * n).reshape(n_axes, n)
            for some, side in ((below, 1), (~below, -1))
        ]
        return np.stack(leaving, axis=1).astype(np.int64)

    def _length_inside(
        self, axis: int, spots: FloatArray, enter: FloatArray, leave: FloatArray
    ) -> float:
        """Return the length of segments of lines along an axis that is inside."""
        axes = np.full(len(spots), axis)
        crossings = self._crossings.of(axes, spots)
        line, heights, turns, first, depths = in_order(*crossings)
        # Counted from the end of the line, too: in an open mesh the two may differ.
        leftover = np.bincount(line, turns, len(spots))[line]
        within = (depths > 0) & (depths > leftover)
        inside = np.flatnonzero(within[:-1] & ~first[1:])
        rows = line[inside]
        start = np.maximum(heights[inside], enter[rows])
        end = np.minimum(heights[inside + 1], leave[rows])
        return float(np.maximum(end - start, 0.0).sum())


def inside_test(corners: FloatArray, n_axes: int) -> Steps[InsideTest]:
    """Return what tells by lines what is inside a solid.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of the triangles, counter-clockwise seen from outside.
    n_axes : int
        Number of axes to ask about points: 1 if the mesh is closed, else 3.
    """
    local = corners @ AXES.T
    return InsideTest(local, (yield from line_crossings(local)), n_axes)


def _turned(shape: CollisionShape) -> CollisionShape:
    """Return a collision shape in the coordinates of the lines."""
    hull = replace(shape.hull, vertices=shape.hull.vertices @ AXES.T)
    center, axes = AXES @ shape.center, shape.axes @ AXES.T
    return replace(shape, hull=hull, center=center, axes=axes)
