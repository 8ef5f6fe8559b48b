"""Containers: lines of sight through enclosed space, such as the hollow of a cup.

Few lines of sight run along the thin wall of a cup. The paper names this limit
(section 6); this module goes beyond the paper. On a coarse grid, it finds the cells
outside the shape whose rays hit the shape in nearly all directions. Two samples also
see each other if the segment between them stays inside the shape or in such cells.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..geometry.frames import cone_directions
from ..geometry.sampling import Samples
from ..steps.progress import Progress, Steps, within
from .lines import RAYS_PER_STEP
from .pair_visibility import PairVisibility
from .ray_march import PASS, RayMarcher

# Cells along the longest side of the bounding box.
_CELLS = 28
# Rays from each cell, one per direction.
_DIRECTIONS = 24
# Try every third direction first.
_FIRST = 3
# A cell is not enclosed if a smaller share of its first rays hits the shape.
_CLEARLY_OPEN = 0.3
# Nothing is enclosed if a smaller share of the first rays hits the shape from each of
# every second cell in all directions of the grid.
_MAY_ENCLOSE = 0.8
# A container has at least one cell where this share of rays hits the shape.
_ENCLOSED = 0.75
# It also holds the connected outside cells with at least this share.
_OPENING = 0.6
# Distance between the points that are tested along a segment, in cells.
_STRIDE = 0.5
# Length at both ends of a segment that is not tested, in cells.
_ENDS = 1.0
# Segments between two reports of progress.
_SEGMENTS_PER_STEP = 2**16
# Kinds of cells.
_INSIDE, _ENCLOSED_OUTSIDE, _OPEN = np.arange(3, dtype=np.uint8)


@dataclass(frozen=True, eq=False)
class Grid:
    """A grid of cells around a shape.

    Attributes
    ----------
    low : (3,) float
        Lowest corner of the first cell.
    size : float
        Length of a cell's edge.
    kinds : (X, Y, Z) uint8
        Kind of each cell: inside, enclosed outside or open. All border cells are open.
    """

    low: NDArray[np.float64]
    size: float
    kinds: NDArray[np.uint8]

    @property
    def encloses(self) -> bool:
        """Whether any cell is enclosed outside."""
        return bool((self.kinds == _ENCLOSED_OUTSIDE).any())


def see_through_containers(
    marcher: RayMarcher, samples: Samples, *matrices: PairVisibility
) -> Steps[list[PairVisibility]]:
    """Return the pairs that see each other if enclosed space counts as inside.

    Parameters
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.
    samples : Samples
        N points on its surface.
    *matrices : PairVisibility
        Pairs that see each other through the inside only.

    Returns
    -------
    Steps of list of PairVisibility
        One for each matrix. If nothing is enclosed, they are the matrices themselves.
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
    """Find the cells of the outside that a shape encloses.

    Parameters
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.

    Returns
    -------
    Steps of Grid
        In the space of the marcher's mesh. All cells are open if nothing is enclosed.
    """
    low, high = marcher.mesh.bounds
    size = float((high - low).max()) / _CELLS
    shape = np.maximum(np.ceil((high - low) / size), 1).astype(np.int64)
    low = (low + high - shape * size) / 2
    centers = low + (np.indices(shape).reshape(3, -1).T + 0.5) * size
    directions = cone_directions(np.array([[0.0, 0.0, 1.0]]), _DIRECTIONS, 2 * np.pi)[0]
    order = np.argsort(np.arange(_DIRECTIONS) % _FIRST, kind="stable")
    first, others = np.split(directions[order], [-(-_DIRECTIONS // _FIRST)])
    # Try every second cell of each row first: most shapes enclose nothing.
    some = (np.indices(shape) % 2 == (shape // 2 % 2)[:, None, None, None]).all(axis=0)
    front, back = yield from within(
        _hits(marcher, centers[some.ravel()], first), 0, 0.1
    )
    if ((front + back)[front >= back] < _MAY_ENCLOSE * len(first)).all():
        return Grid(low - size, size, np.full(shape + 2, _OPEN))
    front, back = yield from within(_hits(marcher, centers, first), 0.1, 0.7)
    # Most cells are decided by now: they are inside, or clearly open.
    doubtful = (front >= back) & (front + back >= _CLEARLY_OPEN * len(first))
    steps = _hits(marcher, centers[doubtful], others)
    more = yield from within(steps, 0.7, 1.0)
    front[doubtful] += more[0]
    back[doubtful] += more[1]
    tried = np.where(doubtful, _DIRECTIONS, len(first))
    outside = (front >= back).reshape(shape)
    shares = ((front + back) / tried).reshape(shape)
    kinds = np.where(outside, _OPEN, _INSIDE)
    kinds[_enclosed(outside, shares)] = _ENCLOSED_OUTSIDE
    return Grid(low - size, size, np.pad(kinds, 1, constant_values=_OPEN))


def see_through(
    grid: Grid, starts: NDArray[np.float64], ends: NDArray[np.float64]
) -> Steps[NDArray[np.bool_]]:
    """Find the segments that run through enclosed cells but not through open ones.

    Parameters
    ----------
    grid : Grid
        Cells around the shape.
    starts, ends : (M, 3) float
        Ends of the segments on the surface, in the space of the grid.

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
    """Return the result of `see_through` for the segments of one step."""
    through = np.zeros(len(starts), dtype=bool)
    # Units are cells. Columns and single precision for speed: the loop below takes most
    # of the time.
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
        # Drop segments at their first open cell; few are followed to their end.
        through[going[met == _OPEN]] = False
        on = (met != _OPEN) & (stride * _STRIDE < inner)
        going, inner = going[on], inner[on]
        units, origins = units[:, on], origins[:, on]
    return through


def _hits(
    marcher: RayMarcher, points: NDArray[np.float64], directions: NDArray[np.float64]
) -> Steps[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Count the directions in which each point meets the front or back of the shape."""
    front, back = np.zeros((2, len(points)), dtype=np.int64)
    for number, direction in enumerate(directions):
        for start in range(0, len(points), RAYS_PER_STEP):
            yield Progress("Containers", number / len(directions))
            rows = np.arange(start, min(start + RAYS_PER_STEP, len(points)))
            met, facing = _meet(marcher, points[rows], direction)
            front[rows[met]] += facing < 0
            back[rows[met]] += facing > 0
    return front, back


def _meet(
    marcher: RayMarcher, points: NDArray[np.float64], direction: NDArray[np.float64]
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Return which rays hit the shape, and normal · direction at each hit."""
    triangles, distances = marcher.caster.first_hit(
        points,
        np.broadcast_to(direction, points.shape),
        np.full(len(points), 2 * marcher.diagonal),
    )
    # Cells of a flat sheet lie on the surface itself: ignore hits at distance 0.
    met = (triangles >= 0) & (distances > PASS * marcher.diagonal)
    return met, marcher.normals[triangles[met]] @ direction


def _enclosed(
    outside: NDArray[np.bool_], shares: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return the enclosed cells, from each cell's share of rays that hit the shape."""
    # Shares of so few rays are noisy: average them over neighboring outside cells,
    # whose shares are nearly the same.
    weights = ndimage.uniform_filter(outside.astype(float), 3)
    sums = ndimage.uniform_filter(np.where(outside, shares, 0.0), 3)
    shares = np.divide(sums, weights, out=np.zeros_like(sums), where=outside)
    containers, _ = ndimage.label(outside & (shares >= _OPENING))
    found = np.unique(containers[outside & (shares >= _ENCLOSED)])
    enclosed = np.isin(containers, found[found > 0])
    # Add one layer of cells, up to the rim, where half of the rays leave.
    dilated: NDArray[np.bool_] = ndimage.binary_dilation(enclosed) & outside
    return dilated
