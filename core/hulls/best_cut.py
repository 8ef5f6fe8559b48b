"""Find the plane that cuts a piece into two sides with the cheapest hulls."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..steps.progress import Progress, Steps
from .cost import cost_of_sides, least_cost_of_sides
from .cut_planes import ranked_planes
from .piece import Cell, cut

# Number of planes that are cut with, to compare the exact costs of both sides.
_TRIES = 8
# Two planes count as the same above this cosine between their normals and below this
# difference of their offsets; the longest side of the shape is 2.
_ALIKE = 0.95
_NEAR = 0.05


def best_cut(cell: Cell) -> Steps[tuple[Cell, Cell] | None]:
    """Cut a piece by the plane whose two sides have the lowest cost.

    All planes are ranked by the volume that the hulls of both sides add. Only the
    first few different ones are cut with, and compared by `cost_of_sides`: the errors
    of both hulls and the volume that they add.

    Parameters
    ----------
    cell : Cell

    Returns
    -------
    Steps of tuple of two Cells or None
        The pieces below and above the plane. None if no plane has some of the surface
        on both sides.
    """
    best, least = None, np.inf
    solid_volume = cell.solid.volume
    planes = yield from ranked_planes(cell)
    for plane in _distinct(planes):
        yield Progress("Cutting", 1.0)
        sides = cut(cell, plane)
        if not all(side.on_surface.any() for side in sides):
            continue
        if least_cost_of_sides(*sides, solid_volume) >= least:
            continue
        cost = cost_of_sides(*sides, solid_volume)
        if cost < least:
            best, least = sides, cost
    return best


def _distinct(planes: NDArray[np.float64]) -> Iterator[NDArray[np.float64]]:
    """Yield the first planes (4,) that differ from those before, `_TRIES` at most."""
    taken = np.zeros((0, 4))
    for plane in planes:
        along = taken[:, :3] @ plane[:3]
        shifts = np.abs(np.sign(along) * taken[:, 3] - plane[3])
        if not ((np.abs(along) > _ALIKE) & (shifts < _NEAR)).any():
            yield plane
            taken = np.concatenate([taken, plane[None]])
        if len(taken) == _TRIES:
            return
