"""Containers: what a shape encloses counts as inside, a step beyond the paper.

Hardly a line of sight runs along the thin wall of a cup: a limit that the paper names
(section 6). Here the enclosed outside, such as the hollow of a cup, is found on a
coarse grid, where rays in nearly all directions meet the shape. Samples whose segment
stays in the inside or in there see each other, too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..geometry.sampling import Samples
from ..steps.progress import Progress, Steps, within
from .cone import cone_directions
from .lines import RAYS_PER_STEP
from .pairs import PairVisibility
from .ray_march import PASS, RayMarcher

# Cells along the longest side of the bounding box.
_CELLS = 28
# Directions of the rays from each cell, and every how manieth is tried first.
_DIRECTIONS = 24
_FIRST = 3
# A first share of rays below which a cell cannot be enclosed.
_HOPELESS = 0.3
# Share of rays that meet the shape where a container begins, and up to where it goes.
_ENCLOSED = 0.75
_OPENING = 0.6
# Segments are looked at every so many cells; their ends, this far, do not count.
_STRIDE = 0.5
_ENDS = 1.0
# Segments between two reports of progress.
_SEGMENTS_PER_STEP = 2**16
# What a cell holds.
_INSIDE, _ENCLOSED_OUTSIDE, _OPEN = np.arange(3, dtype=np.uint8)


@dataclass(frozen=True, eq=False)
class Grid:
    """Cells around a shape.

    Attributes
    ----------
    low : (3,) float
        Corner of the first cell.
    size : float
        Edge of a cell.
    kinds : (X, Y, Z) uint8
        Inside, enclosed outside or open; all cells at the border are open.
    """

    low: NDArray[np.float64]
    size: float
    kinds: NDArray[np.uint8]

    @property
    def encloses(self) -> bool:
        """Whether there is any enclosed outside."""
        return bool((self.kinds == _ENCLOSED_OUTSIDE).any())


def see_through_containers(
    marcher: RayMarcher, samples: Samples, *matrices: PairVisibility
) -> Steps[list[PairVisibility]]:
    """Return what samples see if what the shape encloses counts as inside.

    Parameters
    ----------
    marcher : RayMarcher
        Of the shape.
    samples : Samples
    *matrices : PairVisibility
        Which samples see each other through the inside alone.

    Returns
    -------
    Steps of list of PairVisibility
        For each of the matrices. They are the same objects if nothing is enclosed.
    """
    grid = yield from within(find_enclosed(marcher), 0.0, 0.6)
    if not grid.encloses:
        return list(matrices)
    places, revealed = samples.positions, {}
    for pairs in matrices:
        if pairs not in revealed:
            first, second = pairs.hidden()
            steps = see_through(grid, places[first], places[second])
            through = yield from within(steps, 0.6, 1.0)
            revealed[pairs] = pairs.revealed(first[through], second[through])
    return [revealed[pairs] for pairs in matrices]


def find_enclosed(marcher: RayMarcher) -> Steps[Grid]:
    """Return the cells around a shape, and which of the outside it encloses."""
    low, high = marcher.mesh.bounds
    size = float((high - low).max()) / _CELLS
    shape = np.maximum(np.ceil((high - low) / size), 1).astype(np.int64)
    low = (low + high - shape * size) / 2
    centers = low + (np.indices(shape).reshape(3, -1).T + 0.5) * size
    directions = cone_directions(np.array([[0.0, 0.0, 1.0]]), _DIRECTIONS, 2 * np.pi)[0]
    order = np.argsort(np.arange(_DIRECTIONS) % _FIRST, kind="stable")
    n_first = -(-_DIRECTIONS // _FIRST)
    front, back, tried = np.zeros((3, len(centers)), dtype=np.int64)
    cells = np.arange(len(centers))
    for number, direction in enumerate(directions[order]):
        if number == n_first:
            # Most cells are settled: inside, or far out in the open.
            doubtful = (front >= back) & (front + back >= _HOPELESS * n_first)
            cells = np.flatnonzero(doubtful)
        tried[cells] += 1
        for start in range(0, len(cells), RAYS_PER_STEP):
            yield Progress("Containers", number / _DIRECTIONS)
            chunk = cells[start : start + RAYS_PER_STEP]
            met, facing = _meet(marcher, centers[chunk], direction)
            front[chunk[met]] += facing < 0
            back[chunk[met]] += facing > 0
    outside = (front >= back).reshape(shape)
    shares = ((front + back) / tried).reshape(shape)
    kinds = np.where(outside, _OPEN, _INSIDE)
    kinds[_enclosed(outside, shares)] = _ENCLOSED_OUTSIDE
    return Grid(low - size, size, np.pad(kinds, 1, constant_values=_OPEN))


def see_through(
    grid: Grid, starts: NDArray[np.float64], ends: NDArray[np.float64]
) -> Steps[NDArray[np.bool_]]:
    """Return which segments run through enclosed cells and through none in the open.

    Parameters
    ----------
    grid : Grid
    starts, ends : (M, 3) float
        Points on the surface.

    Returns
    -------
    Steps of (M,) bool
    """
    through = np.zeros(len(starts), dtype=bool)
    for first in range(0, len(starts), _SEGMENTS_PER_STEP):
        yield Progress("Containers", first / len(starts))
        chunk = slice(first, first + _SEGMENTS_PER_STEP)
        through[chunk] = _run_through(grid, starts[chunk], ends[chunk])
    return through


def _run_through(
    grid: Grid, starts: NDArray[np.float64], ends: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return what `see_through` does, for one step's worth of segments."""
    through = np.zeros(len(starts), dtype=bool)
    # In cells, as columns and in single precision: this is where the time goes.
    spans = ((ends - starts) / grid.size).T.astype(np.float32)
    lengths = np.linalg.norm(spans, axis=0)
    going = np.flatnonzero(lengths > 2 * _ENDS)
    units = spans[:, going] / lengths[going]
    origins = ((starts[going] - grid.low) / grid.size).T.astype(np.float32)
    origins += _ENDS * units
    inner = lengths[going] - 2 * _ENDS
    kinds = grid.kinds.ravel()
    steps = np.array([*grid.kinds.strides], dtype=np.int32)
    for stride in range(int(np.ceil(inner.max(initial=0) / _STRIDE)) + 1):
        x, y, z = (origins + np.minimum(stride * _STRIDE, inner) * units).astype(
            np.int32
        )
        met = kinds[x * steps[0] + y * steps[1] + z]
        through[going] |= met == _ENCLOSED_OUTSIDE
        # Segments leave the ranks once they meet the open; few are seen to the end.
        through[going[met == _OPEN]] = False
        on = (met != _OPEN) & (stride * _STRIDE < inner)
        going, inner = going[on], inner[on]
        units, origins = units[:, on], origins[:, on]
    return through


def _meet(
    marcher: RayMarcher, points: NDArray[np.float64], direction: NDArray[np.float64]
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Return which rays meet the shape, and of those the facing of what they meet."""
    triangles, distances = marcher.caster.first_hit(
        points,
        np.broadcast_to(direction, points.shape),
        np.full(len(points), 2 * marcher.diagonal),
    )
    # In a flat sheet, cells lie on the surface itself.
    met = (triangles >= 0) & (distances > PASS * marcher.diagonal)
    return met, marcher.normals[triangles[met]] @ direction


def _enclosed(
    outside: NDArray[np.bool_], shares: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return the enclosed cells, from the shares of rays that meet the shape."""
    # Shares of so few rays are noisy; those of neighbors outside are nearly the same.
    weights = ndimage.uniform_filter(outside.astype(float), 3)
    sums = ndimage.uniform_filter(np.where(outside, shares, 0.0), 3)
    shares = np.divide(sums, weights, out=np.zeros_like(sums), where=outside)
    containers, _ = ndimage.label(outside & (shares >= _OPENING))
    found = np.unique(containers[outside & (shares >= _ENCLOSED)])
    enclosed = np.isin(containers, found[found > 0])
    # One cell more: up to the rim, where half of the rays leave.
    dilated: NDArray[np.bool_] = ndimage.binary_dilation(enclosed) & outside
    return dilated
