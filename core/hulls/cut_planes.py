"""Planes through a piece, ranked by the volume that the hulls of both sides add."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.frames import principal_axes
from ..steps.progress import Progress, Steps
from .extremes import reaches_of, volumes_beside
from .piece import Cell

# Planes along each direction, and around the best one of these in a second look.
_PLANES = 7
_BETWEEN = np.array([-2, -1, 1, 2]) / 3
# Digits to which added volumes are compared.
_DIGITS = 7
# Directions closer than this cosine are one.
_SAME = 0.995
# Points that make a level, digits to which they agree, and levels near one plane.
_POINTS_IN_LEVEL = 4
_LEVEL_DIGITS = 5
_MOST_LEVELS = 6
# A plane passes a level so far on either side: faces in it then belong to one side.
_SKIM = 1e-5
# Points of a piece that are looked at, at most, and those that make a side.
_MOST_POINTS = 2000
_FEWEST_POINTS = 4
# Width of a piece below which it counts as flat.
_FLAT = 1e-6


def ranked_planes(cell: Cell) -> Steps[NDArray[np.float64]]:
    """Return planes through a piece (P, 4), those first whose hulls add least volume.

    Yields Progress; `run` gets the value.
    """
    sketch = _sketch_of(cell)
    planes, added = [], []
    for direction in _directions(cell):
        yield Progress("Cutting", 0.0)
        heights = sketch.points @ direction
        offsets = np.linspace(heights.min(), heights.max(), _PLANES + 2)[1:-1]
        planes += [np.r_[direction, -offset] for offset in offsets]
        added += sketch.added_volumes(direction, offsets)
    # Rounded, so that noise does not choose between planes that are alike. A step of
    # what is built may lie between planes along any direction.
    best = np.round(added, _DIGITS).reshape(-1, _PLANES).argmin(axis=1)
    for row in best + _PLANES * np.arange(len(best)):
        direction, offset = planes[row][:3], -planes[row][3]
        step = np.ptp(sketch.points @ direction) / (_PLANES + 1)
        levels = _levels(cell.points @ direction)
        near = levels[np.abs(levels - offset) < step][:_MOST_LEVELS]
        steps = [offset + _BETWEEN * step, near - _SKIM, near + _SKIM]
        offsets = np.sort(np.concatenate(steps))
        planes += [np.r_[direction, -offset] for offset in offsets]
        added += sketch.added_volumes(direction, offsets)
        yield Progress("Cutting", 0.5)
    order = np.argsort(np.round(added, _DIGITS), kind="stable")
    return np.array(planes)[order[np.isfinite(added)[order]]]


@dataclass(frozen=True, eq=False)
class _Sketch:
    """A piece as some of its points, to compare many planes by.

    Attributes
    ----------
    cell : Cell
    points : (N, 3) float
    rounded : (N, 3) float
        The same, as wide in every direction: extreme points tell nothing of a needle.
    reaches : (E, N) float
        How far these are along the directions of extreme points.
    scale : float
        Volume of the piece over that of the rounded one.
    """

    cell: Cell
    points: NDArray[np.float64]
    rounded: NDArray[np.float64]
    reaches: NDArray[np.float64]
    scale: float

    def added_volumes(
        self, direction: NDArray[np.float64], offsets: NDArray[np.float64]
    ) -> list[float]:
        """Return the volume that hulls on both sides of parallel planes add, (K,).

        Parameters
        ----------
        direction : (3,) float
            The planes' normal.
        offsets : (K,) float
            How far they are along it, rising.
        """
        heights = self.points @ direction
        order = np.argsort(heights)
        ends = np.searchsorted(heights[order], offsets, side="right")
        below, above = volumes_beside(
            self.rounded[order], np.take(self.reaches, order, axis=1), ends
        )
        layer = np.searchsorted(offsets, self.cell.chords @ direction)
        volumes = np.bincount(layer, self.cell.volumes, len(offsets) + 1)
        added = np.maximum(self.scale * below - np.cumsum(volumes)[:-1], 0)
        added += np.maximum(self.scale * above - np.cumsum(volumes[::-1])[-2::-1], 0)
        added[np.minimum(ends, len(order) - ends) < _FEWEST_POINTS] = np.inf
        return list(added)


def _sketch_of(cell: Cell) -> _Sketch:
    """Return a piece as some of its points."""
    points = np.concatenate([cell.boundary, cell.points])
    points = points[:: -(-len(points) // _MOST_POINTS)]
    points = np.concatenate([points, cell.hull.vertices])
    axes = principal_axes(points)
    local = (points - points.mean(axis=0)) @ axes.T
    widths = np.maximum(local.std(axis=0), _FLAT)
    rounded = local / widths
    return _Sketch(cell, points, rounded, reaches_of(rounded), float(np.prod(widths)))


def _levels(heights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return heights that several points share, as in a step of what is built."""
    levels, counts = np.unique(np.round(heights, _LEVEL_DIGITS), return_counts=True)
    return levels[counts >= _POINTS_IN_LEVEL]


def _directions(cell: Cell) -> NDArray[np.float64]:
    """Return the normals of planes worth a try: axes of space and piece, (D, 3).

    Planes along the seams of weakly convex parts measured worse as first cuts.
    """
    own = principal_axes(cell.boundary)
    found: list[NDArray[np.float64]] = []
    for direction in (*np.eye(3), *own):
        if all(abs(direction @ other) < _SAME for other in found):
            found.append(direction)
    return np.array(found)
