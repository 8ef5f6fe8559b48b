"""Where to cut a piece so that the hulls of both sides stray least."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..steps.progress import Progress, Steps
from .cost import cost_of_sides, least_cost_of_sides
from .cut_planes import ranked_planes
from .piece import Cell, cut
from .solid import Solid

# Cuts that are made to see which is best; those alike count as one.
_TRIES = 8
_ALIKE = 0.95
_NEAR = 0.05


def best_cut(solid: Solid, cell: Cell) -> Steps[tuple[Cell, Cell] | None]:
    """Return the two sides of the plane after which hulls stray least.

    Planes are compared by the volume that the hulls of both sides add, and the best
    few by the sum of both errors.

    Returns
    -------
    Steps of tuple of two Cells or None
        None if no plane has some of the surface on both sides.
    """
    best, least = None, np.inf
    solid_volume = float(solid.volumes.sum())
    planes = yield from ranked_planes(cell)
    for plane in _distinct(planes):
        yield Progress("Cutting", 1.0)
        sides = cut(solid, cell, plane)
        if not all(side.on_surface.any() for side in sides):
            continue
        if least_cost_of_sides(*sides, solid_volume) >= least:
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
