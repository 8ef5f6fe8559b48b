"""An upper bound of a collision shape's error, nearly as small as the error itself.

What is known of the distances on a patch: they change at most as fast as the place.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from ...geometry.primitives import CollisionShape, Hull
from ...steps.arrays import FloatArray
from ..convex_hull import THIN
from ..outline import fine_outline
from ..solid import Solid
from .estimate import volume_error
from .fragments import fragments_of, reach_of
from .patch_search import Bounds, PatchSearch
from .surface_within import surface_within
from .targets import Targets
from .uncovered import uncovered

# Errors below this share of the largest one allowed need not be told apart.
_TOLD_APART = 0.5
# Bounds exceed errors by this share at most, where there is time for it; rough ones do
# by more.
_TOLERANCE, _ROUGH_TOLERANCE = 0.03, 0.1
# Longest edge of the first patches where the longest side of the shape is 2, or less.
_COARSE = 0.1


@dataclass(frozen=True)
class ExactError:
    """The error of a collision shape where it is known, as `ErrorBound` gives it.

    Attributes
    ----------
    value : float
    largest : float
        Largest error allowed.
    """

    value: float
    largest: float
    place: ClassVar[FloatArray] = np.zeros((0, 3))

    @property
    def is_allowed(self) -> bool:
        """Whether the error is allowed."""
        return self.value <= self.largest

    @property
    def known(self) -> float:
        """The error; 0 if it is allowed."""
        return 0.0 if self.is_allowed else self.value

    def up_to(self, _: float) -> float:
        """Return the error."""
        return self.value


class ErrorBound:
    """An upper bound of the error of a collision shape, as sharp as it is asked for.

    The error is the largest of four figures, for a shape S around a piece with the
    convex hull C, in a solid M:

    - R_v of CoACD: 0.3 times the radius of a ball as large as what of S is outside M;
    - the largest distance of a point on S, outside M, from the surface of M within S;
    - the largest depth below the surface of S of a point on the surface of M;
    - the largest distance from S of a point of C: what the shape leaves uncovered.

    Parameters
    ----------
    solid : Solid
    shape : CollisionShape
        In the space of the solid.
    hull : Hull
        Convex hull of the piece that the shape stands for.
    largest : float
        Largest error allowed.
    is_sheet : bool, optional
        Whether the hull is only as thick as it was made. This counts in `value` alone.

    Attributes
    ----------
    known : float
        The error is about that or more; 0 if it is allowed or has not been asked for.
    """

    def __init__(
        self,
        solid: Solid,
        shape: CollisionShape,
        hull: Hull,
        largest: float,
        is_sheet: bool = False,
    ) -> None:
        self._solid, self._shape, self._hull = solid, shape, hull
        # Sheets stray by their thickness: cuts would not make up for it.
        self._largest = largest + (THIN if is_sheet else 0.0)
        self._padding = hull.volume if is_sheet else 0.0
        self._inner: PatchSearch | None = None
        self._outer: PatchSearch | None = None
        self.known = 0.0

    @cached_property
    def is_allowed(self) -> bool:
        """Whether the error is surely allowed: found in far less time than `value`."""
        bound = self._bound(self._largest, self._largest, _TOLERANCE)
        allowed = bound <= self._largest
        self.known = 0.0 if allowed else bound
        return allowed

    def up_to(self, limit: float) -> float:
        """Return a rough bound of the error, or any figure above a limit if it is more.

        Errors that are allowed are not told apart.
        """
        return self._bound(self._largest, limit, _ROUGH_TOLERANCE)

    @cached_property
    def value(self) -> float:
        """At least the error, and a few percent more at most.

        Errors below half of the largest one allowed are not told apart. The thickness
        of sheets counts here alone.
        """
        known_allowed = self.__dict__.get("is_allowed", False)
        limit = self._largest if known_allowed else np.inf
        bound = self._bound(self._largest * _TOLD_APART, limit, _TOLERANCE)
        bound = min(bound, limit)  # it is looser where the search ends for its time
        if bound < volume_error(self._shape.volume):
            bound = max(bound, volume_error(self._volume_outside))
        return bound

    @property
    def place(self) -> FloatArray:
        """A point of the shape that is far from the surface, (1, 3), or (0, 3)."""
        return self._outer.place if self._outer else np.zeros((0, 3))

    def _bound(self, enough: float, limit: float, tolerance: float) -> float:
        """Return a bound of the error.

        Errors below `enough` are not told apart, nor are those above `limit`. Others
        are less by a share of `tolerance` at most.
        """
        shape, bound = self._shape, self._uncovered
        self._inner = self._inner or PatchSearch(self._within)
        ends = max(enough, bound), limit, tolerance
        depth = self._inner.largest(lambda c, _: _depths(shape, c), *ends)
        bound = max(bound, depth)
        if bound <= limit:
            ends = max(enough, bound), limit, tolerance
            bound = max(bound, self._farthest(*ends))
        volume = shape.volume - self._padding
        if max(bound, enough) < volume_error(volume) and bound <= limit:
            bound = max(bound, volume_error(self._volume_outside - self._padding))
        return bound

    @cached_property
    def _uncovered(self) -> float:
        """The largest distance from the shape of a point of the hull."""
        return uncovered(self._shape, self._hull)

    @cached_property
    def _within(self) -> FloatArray:
        """What of the solid's surface is within the shape, (N, 3, 3)."""
        return surface_within(self._solid, self._shape)

    @cached_property
    def _targets(self) -> Targets:
        """What distances of points on the shape are measured to."""
        return Targets(self._within if len(self._within) else self._solid.corners)

    @cached_property
    def _volume_outside(self) -> float:
        """How much of the shape is outside the solid."""
        return self._solid.inside.volume_outside(self._shape)

    def _farthest(self, enough: float, limit: float, tolerance: float) -> float:
        """Return a bound of the distance of points on the shape from the surface."""
        outline, gap = fine_outline(self._shape)
        if self._outer is None:
            low, high = self._shape.bounds
            longest = _COARSE * max(1.0, float((high - low).max()) / 2)
            self._outer = PatchSearch(fragments_of(outline, longest)[0])

        def away(corners: FloatArray, level: float) -> Bounds:
            return _distances(self._solid, self._targets, corners, level, gap == 0)

        enough = max(enough - gap, gap)
        return self._outer.largest(away, enough, limit - gap, tolerance) + gap


def _depths(shape: CollisionShape, corners: FloatArray) -> Bounds:
    """Return bounds of the depth of patches below the surface of a shape."""
    centers, radii = reach_of(corners)
    depths = -shape.heights(centers)
    if shape.kind != "HULL":
        return depths, depths + radii
    return depths, -shape.hull.heights_of_patches(corners)


def _distances(
    solid: Solid, targets: Targets, corners: FloatArray, level: float, complete: bool
) -> Bounds:
    """Return bounds of the distance of patches outside a solid from targets.

    `complete` says that the targets are all of the surface that the patches may cross.
    """
    centers, radii = reach_of(corners)
    at_least, nearest, at_most = targets.distances(corners, centers)
    high = np.minimum(at_most, nearest + radii)
    low, hard = np.zeros(len(centers)), np.flatnonzero(high > level)
    is_exact = np.zeros(len(centers), dtype=bool)
    if complete:
        unsure = hard[radii[hard] - at_least[hard] > level]
        at_least[unsure], is_exact[unsure] = targets.nearest(centers[unsure]), True
    # A way from inside to a point outside crosses the surface, if through no hole, and
    # all of the way from the center to there is inside.
    beyond = radii[hard] - (at_least[hard] if complete else 0.0)
    beyond = np.clip(beyond, 0.0, high[hard])
    asked = beyond <= level
    inside, whole = solid.inside.holds_patches(centers[hard], radii[hard], asked)
    high[hard[whole]] = beyond[whole]
    outside = hard[~inside]
    rest = outside[~is_exact[outside]]
    at_least[rest] = targets.nearest(centers[rest])
    low[outside] = at_least[outside]
    high[outside] = np.minimum(high[outside], low[outside] + radii[outside])
    return low, high
