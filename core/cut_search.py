"""Where to cut a piece so that the hulls of both sides stray least."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .axes import principal_axes
from .hull import directions, hull_volume
from .hull_cost import cost_of_sides
from .piece import Cell, cut
from .solid import Solid

# Planes along each direction, and between the best ones of these in a second look.
_PLANES = 7
_BETWEEN = np.array([-2, -1, 1, 2]) / 3
_LOOKED_AT_TWICE = 4
# Digits to which added volumes are compared.
_DIGITS = 7
# Directions closer than this cosine are one.
_SAME = 0.995
# Cuts that are made to see which is best; those alike count as one.
_TRIES = 4
_ALIKE = 0.95
_NEAR = 0.05
# Points that make a level, digits to which they agree, and levels near one plane.
_POINTS_IN_LEVEL = 4
_LEVEL_DIGITS = 5
_MOST_LEVELS = 6
# A plane passes a level so far on either side: faces in it then belong to one side.
_SKIM = 1e-5
# Directions whose extreme points stand for a hull while planes are compared.
_EXTREMES = directions(96)
# Points of a piece that are looked at, at most, and those that make a side.
_MOST_POINTS = 2000
_FEWEST_POINTS = 4
# Share of a part's samples among a piece's from which its seam is followed.
_SMALLEST_PART = 0.05
_FEWEST_SAMPLES = 8


def best_cut(solid: Solid, cell: Cell) -> tuple[Cell, Cell] | None:
    """Return the two sides of the plane after which hulls stray least.

    Planes are compared by the volume that the hulls of both sides add, and the best
    few by the sum of both errors.

    Returns
    -------
    tuple of two Cells or None
        None if no plane has points on both sides.
    """
    best, least = None, np.inf
    solid_volume = float(solid.volumes.sum())
    for plane in _distinct(_ranked_planes(cell)):
        sides = cut(solid, cell, plane)
        if min(len(side.corners) for side in sides) == 0:
            continue
        cost = cost_of_sides(*sides, solid_volume)
        if cost < least:
            best, least = sides, cost
    return best


def _distinct(planes: NDArray[np.float64]) -> Iterator[NDArray[np.float64]]:
    """Yield the first few planes that are not nearly the same."""
    taken = np.zeros((0, 4))
    for plane in planes:
        along = taken[:, :3] @ plane[:3]
        shifts = np.abs(np.sign(along) * taken[:, 3] - plane[3])
        if not ((np.abs(along) > _ALIKE) & (shifts < _NEAR)).any():
            yield plane
            taken = np.concatenate([taken, plane[None]])
        if len(taken) == _TRIES:
            return


def _ranked_planes(cell: Cell) -> NDArray[np.float64]:
    """Return planes through a piece, those first whose hulls add least volume."""
    points = np.concatenate([cell.boundary, cell.points])
    points = points[:: -(-len(points) // _MOST_POINTS)]
    points = np.concatenate([points, cell.hull.vertices])
    reaches = points @ _EXTREMES.T
    planes, added = [], []
    for direction in _directions(cell):
        heights = points @ direction
        low, high = heights.min(), heights.max()
        offsets = np.linspace(low, high, _PLANES + 2)[1:-1]
        planes += [np.r_[direction, -offset] for offset in offsets]
        added += _added_volumes(cell, points, reaches, heights, direction, offsets)
    # Rounded, so that noise does not choose between planes that are alike.
    for row in np.argsort(np.round(added, _DIGITS), kind="stable")[:_LOOKED_AT_TWICE]:
        direction, offset = planes[row][:3], -planes[row][3]
        heights = points @ direction
        step = np.ptp(heights) / (_PLANES + 1)
        levels = _levels(cell.points @ direction)
        near = levels[np.abs(levels - offset) < step][:_MOST_LEVELS]
        steps = [offset + _BETWEEN * step, near - _SKIM, near + _SKIM]
        offsets = np.sort(np.concatenate(steps))
        planes += [np.r_[direction, -offset] for offset in offsets]
        added += _added_volumes(cell, points, reaches, heights, direction, offsets)
    order = np.argsort(np.round(added, _DIGITS), kind="stable")
    return np.array(planes)[order[np.isfinite(added)[order]]]


def _levels(heights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return heights that several points share, as in a step of what is built."""
    levels, counts = np.unique(np.round(heights, _LEVEL_DIGITS), return_counts=True)
    return levels[counts >= _POINTS_IN_LEVEL]


def _directions(cell: Cell) -> NDArray[np.float64]:
    """Return the normals of planes worth a try, (D, 3).

    Across the seams between its parts, the axes of space, and those of the piece.
    """
    own = principal_axes(cell.boundary)
    found: list[NDArray[np.float64]] = []
    for direction in (*_across_seams(cell), *np.eye(3), *own):
        if all(abs(direction @ other) < _SAME for other in found):
            found.append(direction)
    return np.array(found)


def _across_seams(cell: Cell) -> Iterator[NDArray[np.float64]]:
    """Yield the direction that tells each part best from the others (Fisher's)."""
    labelled = cell.parts >= 0
    points, parts = cell.boundary[labelled], cell.parts[labelled]
    for part in np.unique(parts):
        one, other = points[parts == part], points[parts != part]
        fewest = max(_FEWEST_SAMPLES, _SMALLEST_PART * len(points))
        if min(len(one), len(other)) < fewest:
            continue
        scatter = sum(np.cov(side.T) for side in (one, other))
        scatter += 1e-6 * np.trace(scatter) * np.eye(3)
        direction = np.linalg.solve(scatter, one.mean(axis=0) - other.mean(axis=0))
        length = np.linalg.norm(direction)
        if length > 0:
            yield direction / length


def _added_volumes(
    cell: Cell,
    points: NDArray[np.float64],
    reaches: NDArray[np.float64],
    heights: NDArray[np.float64],
    direction: NDArray[np.float64],
    offsets: NDArray[np.float64],
) -> list[float]:
    """Return the volume that hulls on both sides of parallel planes add, (K,).

    Parameters
    ----------
    cell : Cell
    points : (N, 3) float
        Of the piece.
    reaches : (N, E) float
        How far each is along the directions of extreme points.
    heights : (N,) float
        How far each is along the planes' normal.
    direction : (3,) float
        The normal.
    offsets : (K,) float
        How far the planes are along it, rising.
    """
    layer = np.searchsorted(offsets, heights)
    chord_layer = np.searchsorted(offsets, cell.chords @ direction)
    volumes = np.bincount(chord_layer, cell.volumes, len(offsets) + 1)
    counts = np.bincount(layer, minlength=len(offsets) + 1)
    extremes = [
        np.flatnonzero(layer == k)[reaches[layer == k].argmax(axis=0)]
        if counts[k]
        else np.zeros(0, dtype=np.int64)
        for k in range(len(offsets) + 1)
    ]
    below = _hull_volumes(points, reaches, extremes[:-1])
    above = _hull_volumes(points, reaches, extremes[:0:-1])[::-1]
    added = np.maximum(below - np.cumsum(volumes)[:-1], 0)
    added += np.maximum(above - np.cumsum(volumes[::-1])[-2::-1], 0)
    n_below = np.cumsum(counts)[:-1]
    added[np.minimum(n_below, len(points) - n_below) < _FEWEST_POINTS] = np.inf
    return list(added)


def _hull_volumes(
    points: NDArray[np.float64],
    reaches: NDArray[np.float64],
    layers: list[NDArray[np.int64]],
) -> NDArray[np.float64]:
    """Return the volume of the hull of the first layers of points, one, two and on."""
    volumes = []
    rows = np.zeros(0, dtype=np.int64)
    for layer in layers:
        rows = np.unique(np.concatenate([rows, layer]))
        if len(rows):
            rows = rows[np.unique(reaches[rows].argmax(axis=0))]
        volumes.append(hull_volume(points[rows]))
    return np.array(volumes)
