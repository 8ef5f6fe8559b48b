"""Finds which vertices lie at the same place."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..steps.progress import Progress, Steps

# Cells of the grid of places along each axis. They span more than two diagonals.
_CELLS = 2**21
# About the most vertices that are sorted in one step.
_MOST_VERTICES = 2**19


def welded(
    vertices: NDArray[np.float64], triangles: NDArray[np.int64], step: float
) -> Steps[NDArray[np.int32]]:
    """Return the number of the place of each corner of triangles.

    Parameters
    ----------
    vertices : (V, 3) float
    triangles : (T, 3) int
    step : float
        Vertices in one cell of a grid of this width are at one place.

    Returns
    -------
    Steps of (T, 3) int32
        Places are numbered along the axes.
    """
    counts = np.zeros(len(vertices), dtype=np.int64)
    at_once = max(len(vertices), _MOST_VERTICES)
    for start in range(0, len(triangles), at_once):
        yield Progress("Surface", 0.1 * start / len(triangles))
        some = triangles[start : start + at_once]
        counts += np.bincount(some.ravel(), minlength=len(vertices))
    yield Progress("Surface", 0.1)
    center = counts @ vertices / triangles.size
    # One number sorts faster than three. Only vertices that no face uses lie outside
    # the grid.
    places = np.zeros(len(vertices), dtype=np.int64)
    for axis in range(3):
        yield Progress("Surface", 0.2 + 0.1 * axis)
        rounded = np.round((vertices[:, axis] - center[axis]) / step).astype(np.int64)
        places = places * _CELLS + np.clip(rounded + _CELLS // 2, 0, _CELLS - 1)
    yield Progress("Surface", 0.5)
    # Ranges of places, of about as many vertices each, one after the other.
    n_ranges = -(-len(places) // _MOST_VERTICES)
    few = np.sort(places[:: max(len(places) // (1000 * n_ranges), 1)])
    bounds = few[np.arange(1, n_ranges) * len(few) // n_ranges]
    range_of = np.searchsorted(bounds, places, side="right")
    place_of, n_places = np.empty(len(places), dtype=np.int32), 0
    for number in range(n_ranges):
        yield Progress("Surface", 0.5 + 0.4 * number / n_ranges)
        rows = np.flatnonzero(range_of == number)
        different, found = np.unique(places[rows], return_inverse=True)
        place_of[rows] = found.reshape(-1) + n_places
        n_places += len(different)
    yield Progress("Surface", 0.9)
    return place_of[triangles]
