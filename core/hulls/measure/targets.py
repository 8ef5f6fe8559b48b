"""How far patches are from the nearest of many triangles."""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.rows import blocks
from .fragments import distances_to, fragments_of, reach_of

# Longest edge of the fragments by whose centers the nearest triangles are found.
_GRAIN = 0.08
# Fragments near a patch that its distance is measured to.
_NEIGHBORS = 3
# Fragments that the nearest is looked for among, at first.
_FIRST = 12
# Largest number of pairs of a point and a fragment at once.
_MOST_PAIRS = 500_000
# Up to so many triangles are all looked at, rather than the fragments near by.
_FEW = 48
# Where fragments are of many sizes, small ones are looked for by themselves: up to
# these shares of the largest reach.
_SIZES = (1 / 16, 1 / 4)


class _Fragments(NamedTuple):
    """Fragments of triangles, to find those near a point.

    Attributes
    ----------
    tree : cKDTree
        Of their centers.
    origins : (F,) int
        Triangle that each is a piece of.
    radii : (F,) float
        No point of one is farther from its center.
    reach : float
        The largest of these.
    """

    tree: cKDTree
    origins: IntArray
    radii: FloatArray
    reach: float

    @classmethod
    def of(
        cls, centers: FloatArray, radii: FloatArray, origins: IntArray
    ) -> _Fragments:
        """Return fragments with these centers and reaches."""
        # Building a balanced tree takes twice as long, and questions are few.
        tree = cKDTree(centers, balanced_tree=False, compact_nodes=False)
        return cls(tree, origins, radii, float(radii.max()))


class Targets:
    """Triangles that distances are measured to.

    Parameters
    ----------
    corners : (N, 3, 3) float
    """

    def __init__(self, corners: FloatArray) -> None:
        small, origins = fragments_of(corners, _GRAIN)
        self._corners = corners
        self._all = _Fragments.of(*reach_of(small), origins)

    @cached_property
    def _by_size(self) -> list[_Fragments]:
        """All fragments, in groups of about one size."""
        tree, origins, radii, reach = self._all
        sizes = np.searchsorted(np.multiply(_SIZES, reach), radii)
        groups = [np.flatnonzero(sizes == size) for size in np.unique(sizes)]
        if len(groups) == 1:
            return [self._all]
        return [
            _Fragments.of(tree.data[rows], radii[rows], origins[rows])
            for rows in groups
        ]

    def distances(
        self, patches: FloatArray, centers: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return how far patches are from the triangles.

        Parameters
        ----------
        patches : (M, 3, 3) float
            Corners of each patch.
        centers : (M, 3) float
            Their centers.

        Returns
        -------
        at_least : (M,) float
            No triangle is nearer to the center.
        nearest : (M,) float
            One is that near to the center; another may be nearer.
        at_most : (M,) float
            From no place of the patch is the nearest triangle farther away.
        """
        tree, origins, _, reach = self._all
        n_near = min(_NEIGHBORS, len(origins))
        apart, rows = (x.reshape(-1, n_near) for x in tree.query(centers, n_near))
        places = np.concatenate([patches, centers[:, None]], axis=1)
        away = _from_each(places, self._corners[origins[rows]])
        nearest = away[:, 3].min(axis=1)
        at_least = np.clip(apart[:, -1] - reach, 0.0, nearest)
        # The distance from a triangle is convex: largest at a corner of the patch.
        return at_least, nearest, away.max(axis=1).min(axis=1)

    def are_within(self, points: FloatArray, radii: FloatArray) -> BoolArray:
        """Return which points (M, 3) have a triangle within radii (M,)."""
        farthest = float(radii.max(initial=0.0)) + self._all.reach
        apart, _ = self._all.tree.query(points, distance_upper_bound=farthest)
        # The center of a fragment is on it, and none of it is farther than its reach.
        within: BoolArray = apart <= radii
        unsure = np.flatnonzero(~within & (apart - self._all.reach <= radii))
        nearest = self.nearest(points[unsure], np.nextafter(radii[unsure], np.inf))
        within[unsure] = nearest <= radii[unsure]
        return within

    def nearest(self, points: FloatArray, most: FloatArray | None = None) -> FloatArray:
        """Return the distances of points (M, 3) from the nearest triangles, (M,).

        Where none is nearer than `most` (M,), it is that: larger ones take longer.
        """
        found = np.full(len(points), np.inf) if most is None else most.copy()
        left = np.arange(len(points))
        if len(self._corners) > _FIRST:
            left = self._look(self._all, points, left, _FIRST, found)
        if len(self._corners) <= _FEW:
            for block in blocks(len(left), _MOST_PAIRS // len(self._corners)):
                places = points[left[block], None]
                every = np.broadcast_to(
                    self._corners, (len(places), *self._corners.shape)
                )
                away = _from_each(places, every).min(axis=(1, 2))
                found[left[block]] = np.minimum(found[left[block]], away)
            return found
        for group in self._by_size if len(left) else ():
            # The first ones of all were looked at.
            unsure, n_near = left, 4 * _FIRST if group is self._all else _FIRST
            while len(unsure):
                unsure = self._look(group, points, unsure, n_near, found)
                n_near *= 4
        return found

    def _look(
        self,
        group: _Fragments,
        points: FloatArray,
        rows: IntArray,
        n_near: int,
        found: FloatArray,
    ) -> IntArray:
        """Look for triangles nearer to some points, among the fragments next to them.

        Distances (M,) are updated in `found`. Returns the rows of points that may be
        nearer to others.
        """
        unsure, n_near = [rows[:0]], min(n_near, len(group.origins))
        for block in blocks(len(rows), _MOST_PAIRS // n_near):
            some = rows[block]
            # Fragments whose centers are farther away hold nothing nearer.
            farthest = float(found[some].max()) + group.reach
            ranks = np.arange(1, n_near + 1)
            apart, near = group.tree.query(
                points[some], ranks, distance_upper_bound=farthest
            )
            # Where there is none, the row is behind the last one, and `apart` infinite.
            radii = np.take(group.radii, near, mode="clip")
            point, place = np.nonzero(apart - radii < found[some, None])
            corners = self._corners[group.origins[near[point, place]]]
            away = np.full(apart.shape, np.inf)
            away[point, place] = distances_to(points[some][point], corners)
            found[some] = np.minimum(found[some], away.min(axis=1))
            unsure.append(some[found[some] > apart[:, -1] - group.reach])
        return np.concatenate(unsure) if n_near < len(group.origins) else rows[:0]


def _from_each(places: FloatArray, targets: FloatArray) -> FloatArray:
    """Return distances of places (N, P, 3) from triangles (N, K, 3, 3), (N, P, K)."""
    n, p, k = *places.shape[:2], targets.shape[1]
    away = distances_to(
        np.repeat(places.reshape(-1, 3), k, axis=0),
        np.repeat(targets, p, axis=0).reshape(-1, 3, 3),
    )
    return away.reshape(n, p, k)
