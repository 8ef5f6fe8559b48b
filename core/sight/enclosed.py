"""Enclosed space, such as the hollow of a cup: cells outside where most rays hit.

On a coarse grid, it finds the cells outside the shape whose rays hit the shape in
nearly all directions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..geometry.directions import cone_directions
from ..solids.shells import GAP
from ..steps.arrays import BoolArray, FloatArray
from ..steps.progress import Progress, Steps, within
from .ray_march import PASS, RAYS_PER_STEP, RayMarcher

# Cells along the longest side of the bounding box.
_CELLS = 28
# Rays from each cell, one per direction.
_DIRECTIONS = 24
# Every ninth tells inside from outside, every third which cells may be enclosed.
_FEW, _FIRST = 9, 3
# A cell is not enclosed if a smaller share of its first rays hits the shape.
_CLEARLY_OPEN = 0.3
# Nothing is enclosed if a smaller share of the first rays hits the shape from each of
# every second cell in all directions of the grid.
_MAY_ENCLOSE = 0.8
# A container has at least one cell where this share of rays hits the shape.
_ENCLOSED = 0.75
# It also holds the connected outside cells with at least this share. None is farther
# than two cells from a cell of which this share of the first rays hits.
_OPENING = 0.6
# Numbers of the directions.
_TURNS = np.arange(_DIRECTIONS)
# Kinds of cells.
INSIDE, ENCLOSED_OUTSIDE, OPEN = np.arange(3, dtype=np.uint8)


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

    low: FloatArray
    size: float
    kinds: NDArray[np.uint8]


def find_enclosed(marcher: RayMarcher) -> Steps[Grid | None]:
    """Find the cells of the outside that a shape encloses.

    Parameters
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.

    Returns
    -------
    Steps of Grid or None
        In the space of the marcher's mesh. None if nothing is enclosed.
    """
    low, high = marcher.mesh.bounds
    size = float((high - low).max()) / _CELLS
    shape = np.maximum(np.ceil((high - low) / size), 1).astype(np.int64)
    low = (low + high - shape * size) / 2
    places = np.moveaxis(np.indices(shape), 0, -1)
    hits = _Hits(marcher, low + (places + 0.5) * size)
    # Try every second cell of each row first: most shapes enclose nothing.
    some = (places % 2 == shape // 2 % 2).all(axis=-1)
    yield from within(hits.cast(some, _TURNS % _FIRST == 0), 0, 0.1)
    likely = hits.hidden(_MAY_ENCLOSE)
    if not likely.any():
        return None
    near = _grown(hits.hidden(_OPENING))
    # A few rays of one cell say little: look around such cells first.
    likely = _grown(likely)
    yield from within(hits.cast_around(likely, likely), 0.1, 0.2)
    shares = np.where(likely, hits.shares, 0.0)
    if not _enclosed(likely & hits.outside, shares).any():
        return None
    # What is enclosed is decided near hidden cells; averages need others around them.
    yield from within(hits.cast_around(near, _grown(near)), 0.2, 0.8)
    enclosed = _enclosed(hits.outside, np.where(near, hits.shares, 0.0))
    if not enclosed.any():
        return None
    yield from within(hits.cast(hits.n_cast == 0, _TURNS % _FEW == 0), 0.8, 1.0)
    kinds = np.where(hits.outside, OPEN, INSIDE)
    kinds[enclosed] = ENCLOSED_OUTSIDE
    return Grid(low - size, size, np.pad(kinds, 1, constant_values=OPEN))


def _grown(cells: BoolArray) -> BoolArray:
    """Return cells (X, Y, Z), and all that are at most two cells away from them."""
    return ndimage.binary_dilation(cells, np.ones((5, 5, 5)))


class _Hits:
    """Rays that meet the front or the back of a shape, of those cast from cells.

    Attributes
    ----------
    front, back, near, n_cast : (X, Y, Z) int
        Those near are within the width of a gap between shells.
    """

    def __init__(self, marcher: RayMarcher, centers: FloatArray) -> None:
        self._marcher, self._points = marcher, centers.reshape(-1, 3)
        upwards = np.array([[0.0, 0.0, 1.0]])
        self._directions = cone_directions(upwards, _DIRECTIONS, 2 * np.pi)[0]
        counts = np.zeros((4, *centers.shape[:3]), dtype=np.int64)
        self.front, self.back, self.near, self.n_cast = counts
        self._counts = counts.reshape(4, -1)

    @property
    def shares(self) -> FloatArray:
        """The share of each cell's rays that hit the shape, 0 without rays."""
        return (self.front + self.back) / np.maximum(self.n_cast, 1)

    @property
    def outside(self) -> BoolArray:
        """Which cells lie outside. Those without rays count as such.

        The gap between two shells that were set apart is none of the outside. Beside a
        single wall, no more than half of the rays meet it near by.
        """
        in_gap = 2 * self.near > self.n_cast
        return (self.front >= self.back) & ~in_gap

    def hidden(self, share: float) -> BoolArray:
        """Return the cells outside from which at least this share hits the shape."""
        return self.outside & (self.shares >= share)

    def cast_around(self, cells: BoolArray, around: BoolArray) -> Steps[None]:
        """Cast few rays around some cells, more from them, and all that may matter.

        Cells that rays were cast from have had their first ones.
        """
        few, first = _TURNS % _FEW == 0, _TURNS % _FIRST == 0
        fresh = self.n_cast == 0
        yield from within(self.cast(around & fresh, few), 0.0, 0.2)
        yield from within(self.cast(cells & fresh, first & ~few), 0.2, 0.5)
        # Most cells are decided by now: they are inside, or clearly open.
        doubtful = cells & self.hidden(_CLEARLY_OPEN) & (self.n_cast < _DIRECTIONS)
        yield from within(self.cast(doubtful, ~first), 0.5, 1.0)

    def cast(self, chosen: BoolArray, turns: BoolArray) -> Steps[None]:
        """Cast rays from the chosen cells, one in each chosen direction."""
        directions, (front, back, close, n_cast) = self._directions[turns], self._counts
        chosen_rows = np.flatnonzero(chosen)
        for number, direction in enumerate(directions):
            for start in range(0, len(chosen_rows), RAYS_PER_STEP):
                yield Progress("Containers", number / len(directions))
                rows = chosen_rows[start : start + RAYS_PER_STEP]
                met, facing, near = _meet(self._marcher, self._points[rows], direction)
                close[rows[near]] += 1
                front[rows[met]] += facing < 0
                back[rows[met]] += facing > 0
                n_cast[rows] += 1


def _meet(
    marcher: RayMarcher, points: FloatArray, direction: FloatArray
) -> tuple[BoolArray, FloatArray, BoolArray]:
    """Return which rays hit the shape, normal · direction at each hit, which are near.

    Those are within the width of a gap between shells.
    """
    triangles, distances = marcher.first_hit(
        points,
        np.broadcast_to(direction, points.shape),
        np.full(len(points), 2 * marcher.diagonal),
    )
    # Cells of a flat sheet lie on the surface itself: ignore hits at distance 0.
    met = (triangles >= 0) & (distances > PASS * marcher.diagonal)
    near = met & (distances < GAP * marcher.diagonal)
    return met, marcher.normals[triangles[met]] @ direction, near


def _enclosed(outside: BoolArray, shares: FloatArray) -> BoolArray:
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
    return ndimage.binary_dilation(enclosed) & outside
