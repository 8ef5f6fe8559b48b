"""Containers: lines of sight through enclosed space, such as the hollow of a cup.

Few lines of sight run along the thin wall of a cup. The paper names this limit
(section 6); this module goes beyond the paper: two samples also see each other if the
segment between them stays inside the shape or in enclosed cells.
"""

from __future__ import annotations

import numpy as np

from ..geometry.sampling import Samples
from ..steps.arrays import BoolArray, FloatArray, IntArray
from ..steps.progress import Progress, Steps, within
from ..steps.rows import blocks
from .enclosed import ENCLOSED_OUTSIDE, OPEN, Grid, find_enclosed
from .pair_visibility import PairVisibility
from .ray_march import RayMarcher

# Distance between the points that are tested along a segment, in cells.
_STRIDE = 0.5
# Length at both ends of a segment that is not tested, in cells.
_ENDS = 1.0
# Points of a segment that are tested before those that ended are left out.
_STRIDES_AT_ONCE = 8


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
    if grid is None:
        return list(matrices)
    places, revealed = samples.positions, {}
    for pairs in matrices:
        if pairs not in revealed:
            first, second = pairs.hidden()
            steps = see_through(grid, places, first, second)
            through = yield from within(steps, 0.6, 1.0)
            revealed[pairs] = pairs.revealed(first[through], second[through])
    return [revealed[pairs] for pairs in matrices]


def see_through(
    grid: Grid, places: FloatArray, first: IntArray, second: IntArray
) -> Steps[BoolArray]:
    """Find the segments that run through enclosed cells but not through open ones.

    Parameters
    ----------
    grid : Grid
        Cells around the shape.
    places : (N, 3) float
        Points of the surface, in the space of the grid.
    first, second : (M,) int
        Their rows at the ends of each segment.

    Returns
    -------
    Steps of (M,) bool
    """
    through = np.zeros(len(first), dtype=bool)
    for rows in blocks(len(first)):
        yield Progress("Containers", rows.start / len(first))
        through[rows] = _run_through(grid, places[first[rows]], places[second[rows]])
    return through


def _run_through(grid: Grid, starts: FloatArray, ends: FloatArray) -> BoolArray:
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
    enclosed, opened = np.zeros((2, len(going)), dtype=bool)
    for stride in range(int(np.ceil(inner.max(initial=0) / _STRIDE)) + 1):
        at = units * np.minimum(np.float32(stride * _STRIDE), inner)
        at += origins
        x, y, z = at.astype(np.int32)
        met = kinds[x * steps[0] + y * steps[1] + z]
        enclosed |= met == ENCLOSED_OUTSIDE
        opened |= met == OPEN
        if stride % _STRIDES_AT_ONCE:
            continue
        # Drop segments that met an open cell: few are followed to their end.
        ended = stride * _STRIDE >= inner
        through[going[ended & enclosed & ~opened]] = True
        on = ~(opened | ended)
        going, inner, enclosed, opened = (
            a[on] for a in (going, inner, enclosed, opened)
        )
        units, origins = units[:, on], origins[:, on]
    through[going[enclosed & ~opened]] = True
    return through
