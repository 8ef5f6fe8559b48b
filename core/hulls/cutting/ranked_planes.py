"""Rank planes through a piece by the volume that the hulls of both sides would add."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...geometry.frames import principal_axes, settled
from ...steps.arrays import BoolArray, FloatArray
from ...steps.progress import Progress, Steps
from ..convex_hull import THIN, thickened
from .cell import Cell
from .extremes import reaches_of, volumes_beside
from .plane_directions import directions_of

# Number of evenly spaced planes along each direction.
_PLANES = 7
# Offsets of further planes around the best of these, in units of their spacing.
_BETWEEN = np.array([-2, -1, 1, 2]) / 3
# Decimal digits to which added volumes are compared.
_DIGITS = 7
# A level is a height that at least this many points share, such as that of a flat face.
_POINTS_IN_LEVEL = 4
# Decimal digits to which the heights of one level agree.
_LEVEL_DIGITS = 5
# Largest number of levels tried around one plane.
_MOST_LEVELS = 6
# Flat faces have at least this share of a piece's points. Planes beside one rank as if
# both hulls added less by a share of the solid's volume: estimates are no sharper, and
# such planes may divide blocks exactly.
_FLAT_FACE, _BONUS = 0.01, 3e-3
# Noise would decide between a plane next to a flat face and one that is nearer to the
# face than this; the longest side is 2.
_CROWDED = 0.05
# Planes lie below and above a level, so that its faces are all on one side. What
# is between counts as added: 1e-5 would make errors of about 0.003, this makes 0.0007.
_BESIDE = np.array([-1e-7, 1e-7])
# Largest number of boundary points that planes are compared by.
_MOST_POINTS = 2000
# Least number of points on either side of a plane.
_FEWEST_POINTS = 4
# Least standard deviation of points along an axis, to divide by; the longest side is 2.
_FLAT = 1e-6


def ranked_planes(cell: Cell) -> Steps[tuple[FloatArray, bool]]:
    """Return planes through a piece, ranked by the volume that both hulls add.

    Evenly spaced planes are tried along each direction. Then others around the best of
    these, and next to flat faces: of a block next to all large ones.

    Parameters
    ----------
    cell : Cell

    Returns
    -------
    planes : (P, 4) float
        Unit normal n and offset d of each plane, n · x + d = 0, by the added volume.
    is_block : bool
        See `directions_of`.
    """
    sketch, planes, added, gains = _sketch_of(cell), [], [], []
    directions, is_block = directions_of(cell)
    corners = _with_thickness(cell, cell.points)
    for turn, direction in enumerate(directions):
        yield Progress("Cutting", turn / len(directions))
        ordered, heights, chords = sketch.along(direction)
        low, high = heights[[0, -1]]
        offsets = _off_faces(np.linspace(low, high, _PLANES + 2)[1:-1], heights)
        first = ordered.added_volumes(heights, chords, offsets)
        # Noise does not decide between equal planes. Flat faces may lie between them.
        best = offsets[np.round(first, _DIGITS).argmin()]
        yield Progress("Cutting", turn / len(directions))
        step = (high - low) / (_PLANES + 1)
        levels = _levels(at_corners := np.sort(corners @ direction))
        near = levels[np.abs(levels.mean(axis=1) - best) < step][:_MOST_LEVELS]
        on_faces = at_corners if cell.is_sheet else heights
        flat = _flat_levels(levels if is_block else near, on_faces)
        beside = np.concatenate([near, flat]) + _BESIDE
        others = np.union1d(_off_faces(best + _BETWEEN * step, heights), beside)
        second = ordered.added_volumes(heights, chords, others)
        offsets = np.concatenate([offsets, others])
        volumes, flush = np.concatenate([first, second]), flat + _BESIDE
        volumes -= _BONUS * cell.solid.volume * np.isin(offsets, flush)
        added.append(np.where(is_block & _crowded(offsets, flush), np.inf, volumes))
        planes.append(np.c_[np.tile(direction, (len(offsets), 1)), -offsets])
        # By how much planes shorten the longer side, as a square: ties end so.
        gains.append((high - low) ** 2 - np.maximum(offsets - low, high - offsets) ** 2)
    if cell.fit.parameters.shape == "CYLINDER":  # it may well be flat
        gains = [np.zeros(len(each)) for each in gains]
    volumes = np.concatenate(added)
    order = np.lexsort(np.round([-np.concatenate(gains), volumes], _DIGITS))
    ranked = np.concatenate(planes)[order[np.isfinite(volumes)[order]]]
    return settled(ranked), is_block


@dataclass(frozen=True, eq=False)
class _Sketch:
    """Some points of a piece, by which many planes are compared quickly.

    Attributes
    ----------
    cell : Cell
    points : (N, 3) float
    rounded : (N, 3) float
        The points scaled to standard deviation 1 along each principal axis. Extreme
        points in fixed directions describe a thin needle badly.
    reaches : (E, N) float
        Coordinates of `rounded` along the directions of `extremes`.
    scale : float
        Factor from volumes of `rounded` to volumes of the piece.
    """

    cell: Cell
    points: FloatArray
    rounded: FloatArray
    reaches: FloatArray
    scale: float

    def along(self, direction: FloatArray) -> tuple[_Sketch, FloatArray, FloatArray]:
        """Return the sketch in order of the heights of points along a direction (3,).

        The others are these heights, (N,), and those of the chords, (C,).
        """
        heights = self.points @ direction
        order = np.argsort(heights)
        ordered = replace(
            self,
            points=self.points[order],
            rounded=self.rounded[order],
            reaches=np.take(self.reaches, order, axis=1),
        )
        return ordered, heights[order], self.cell.places @ direction

    def added_volumes(
        self, heights: FloatArray, chords: FloatArray, offsets: FloatArray
    ) -> FloatArray:
        """Return the volumes that the hulls of both sides of parallel planes add.

        Parameters
        ----------
        heights, chords : (N,) and (C,) float
            As `along` returns them with this sketch.
        offsets : (K,) float
            Height of each plane, ascending.

        Returns
        -------
        (K,) float
            `inf` for planes with too few points on one side.
        """
        ends = np.searchsorted(heights, offsets, side="right")
        below, above = volumes_beside(self.rounded, self.reaches, ends)
        layer = np.searchsorted(offsets, chords)
        each = self.cell.solid.volumes[self.cell.chords]
        volumes = np.bincount(layer, each, len(offsets) + 1)
        added = np.maximum(self.scale * below - np.cumsum(volumes)[:-1], 0)
        added += np.maximum(self.scale * above - np.cumsum(volumes[::-1])[-2::-1], 0)
        added[np.minimum(ends, len(heights) - ends) < _FEWEST_POINTS] = np.inf
        return added


def _sketch_of(cell: Cell) -> _Sketch:
    """Choose the points of a piece, and scale them to equal widths."""
    points = np.concatenate([cell.boundary, cell.points])
    points = _with_thickness(cell, points)
    points = points[:: -(-len(points) // _MOST_POINTS)]
    points = np.concatenate([points, cell.hull.vertices])
    axes = principal_axes(points)
    local = (points - points.mean(axis=0)) @ axes.T
    widths = np.maximum(local.std(axis=0), _FLAT)
    rounded = local / widths
    return _Sketch(cell, points, rounded, reaches_of(rounded), float(np.prod(widths)))


def _with_thickness(cell: Cell, points: FloatArray) -> FloatArray:
    """Return points of a piece, those of a sheet as thick as its hull."""
    return thickened(points, THIN) if cell.is_sheet else points


def _off_faces(offsets: FloatArray, heights: FloatArray) -> FloatArray:
    """Return offsets (K,) of planes, with two beside each plane that points lie on.

    Rounding would decide on which side these points are. `heights` are those of all
    points, ascending.
    """
    beside = offsets[:, None] + _BESIDE
    ends = np.searchsorted(heights, offsets[:, None] + _BESIDE / 2)
    clear = ends[:, 0] == ends[:, 1]
    return np.sort(np.concatenate([offsets[clear], beside[~clear].ravel()]))


def _levels(ascending: FloatArray) -> FloatArray:
    """Return the lowest and highest height of levels, such as flat faces, (L, 2).

    The points of a level agree up to rounding: a turned face is not quite even.
    """
    _, starts, counts = np.unique(
        np.round(ascending, _LEVEL_DIGITS), return_index=True, return_counts=True
    )
    several = counts >= _POINTS_IN_LEVEL
    ends = (starts + counts)[several] - 1
    return np.stack([ascending[starts[several]], ascending[ends]], axis=1)


def _flat_levels(levels: FloatArray, heights: FloatArray) -> FloatArray:
    """Return the levels at which the largest flat faces lie, at most `_MOST_LEVELS`.

    `heights` are those of points spread over the surface, or of the corners of a sheet,
    ascending.
    """
    ends = np.searchsorted(heights, levels + _BESIDE)
    counts = np.diff(ends, axis=1)[:, 0]
    largest = np.argsort(-counts, kind="stable")[:_MOST_LEVELS]
    return levels[largest[counts[largest] >= _FLAT_FACE * len(heights)]]


def _crowded(offsets: FloatArray, flush: FloatArray) -> BoolArray:
    """Return which planes at offsets (K,) are near flush ones (L, 2), none of them."""
    away = np.abs(offsets[:, None] - flush.ravel()).min(axis=1, initial=np.inf)
    return (away > 0) & (away < _CROWDED)
