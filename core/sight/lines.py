"""Whether two samples see each other, through the inside (sections 3 and 5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..steps.arrays import BoolArray, IntArray
from ..steps.progress import Progress, Steps
from .ray_march import MOST_CASTS, RAYS_PER_STEP
from .viewpoints import Viewpoints

# Lines of the first step of all, which tells how many rays a line takes.
_FIRST_LINES = 512


@dataclass(eq=False)
class RayBudget:
    """How many rays may still be cast.

    A line of sight takes a ray for each surface that it passes, so that lines through
    many shells cost more.

    Attributes
    ----------
    left : float
        Rays that may still be cast; `inf` without a limit.
    n_lines, n_rays : int
        Lines and rays that were cast.
    """

    left: float = np.inf
    n_lines: int = 0
    n_rays: int = 0

    @property
    def lines_left(self) -> float:
        """Number of lines that the rays left are expected to suffice for."""
        return self.left * max(self.n_lines, 1) / max(self.n_rays, 1)

    @property
    def lines_per_step(self) -> int:
        """Number of lines to cast between two reports: fewer through many shells."""
        if not self.n_rays:
            return _FIRST_LINES
        return max(min(RAYS_PER_STEP, MOST_CASTS * self.n_lines // self.n_rays), 1)

    def spend(self, n_lines: int, n_rays: int) -> None:
        """Note that some lines took some rays."""
        self.n_lines += n_lines
        self.n_rays += n_rays
        self.left -= n_rays


def faces_inside(views: Viewpoints, first: IntArray, second: IntArray) -> BoolArray:
    """Test which pairs of samples face each other through the inside.

    Lines of sight need this, and it costs no ray: each end of a segment lies below the
    tangent plane of the other end. It may lie above by the error of the normals, the
    `tilt` of the marcher. Ends that another shell encloses are not tested.

    Parameters
    ----------
    views : Viewpoints
    first, second : (M,) int
        Rows of the viewpoints of each pair. Arrays of other shapes are broadcast.

    Returns
    -------
    facing : (M,) bool
    """
    samples, tilt = views.samples, views.marcher.tilt
    # Coordinate by coordinate: NumPy is slow with axes of length 3.
    axes = list(zip(views.positions.T.copy(), samples.normals.T.copy(), strict=True))
    planes = np.einsum("nd,nd->n", samples.normals, samples.positions)

    def below(ends: IntArray, others: IntArray) -> BoolArray:
        heights = sum(place[others] * normal[ends] for place, normal in axes)
        allowed = planes[ends]
        if tilt:
            towards = views.positions[others] - samples.positions[ends]
            allowed = allowed + tilt * np.linalg.norm(towards, axis=-1)
        return (heights < allowed) | views.enclosed[ends]

    return below(first, second) & below(second, first)


def see_pairs(
    views: Viewpoints,
    first: IntArray,
    second: IntArray,
    budget: RayBudget | None = None,
) -> Steps[BoolArray]:
    """Find out which of the given pairs of samples are in line of sight.

    Parameters
    ----------
    views : Viewpoints
    first, second : (M,) int
        Rows of the viewpoints of each pair.
    budget : RayBudget, optional
        Unlimited by default.

    Returns
    -------
    Steps of (L,) bool
        For the first L pairs: all M if the budget suffices.
    """
    visible = first == second
    facing = faces_inside(views, first, second)
    candidates = np.flatnonzero(~visible & facing)
    lines = first[candidates], second[candidates]
    seen = yield from cast_lines(views, *lines, budget or RayBudget())
    visible[candidates[: len(seen)]] = seen
    return visible[: candidates[len(seen)]] if len(seen) < len(candidates) else visible


def cast_lines(
    views: Viewpoints, first: IntArray, second: IntArray, budget: RayBudget
) -> Steps[BoolArray]:
    """Find out by rays which pairs, of those that face each other, see each other.

    Parameters
    ----------
    views : Viewpoints
    first, second : (M,) int
        Rows of the viewpoints of each pair.
    budget : RayBudget
        Where it ends, the pairs that follow are left out. What is cast is noted in it.

    Returns
    -------
    Steps of (L,) bool
        For the first L pairs: all M if the budget suffices.
    """
    visible, done = np.zeros(len(first), dtype=bool), 0
    while done < len(first) and budget.lines_left >= 1:
        yield Progress("Lines of sight", done / len(first))
        most = min(budget.lines_per_step, len(first) - done)
        stop = done + int(min(budget.lines_left, most))
        before = views.marcher.n_cast
        visible[done:stop] = _sees(views, first[done:stop], second[done:stop])
        budget.spend(stop - done, views.marcher.n_cast - before)
        done = stop
    return visible[:done]


def _sees(views: Viewpoints, first: IntArray, second: IntArray) -> BoolArray:
    """Return whether the segment between each pair stays inside, (M,) bool."""
    segments = views.positions[second] - views.positions[first]
    lengths = np.linalg.norm(segments, axis=1)
    lengths = np.maximum(lengths, np.finfo(float).tiny)
    exits, _, _ = views.marcher.march(
        views.positions[first],
        segments / lengths[:, None],
        lengths,
        views.depths[first],
    )
    return exits < 0
