"""How far patches are from the nearest of many triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

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


class Targets:
    """Triangles that distances are measured to.

    Parameters
    ----------
    corners : (N, 3, 3) float
    """

    def __init__(self, corners: NDArray[np.float64]) -> None:
        small, origins = fragments_of(corners, _GRAIN)
        self._corners, self._origins = corners, origins
        centers, radii = reach_of(small)
        self._reach = float(radii.max())
        # Building a balanced tree takes twice as long, and questions are few.
        self._tree = cKDTree(centers, balanced_tree=False, compact_nodes=False)

    def distances(
        self, patches: NDArray[np.float64], centers: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
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
        n_near = min(_NEIGHBORS, len(self._origins))
        apart, rows = (x.reshape(-1, n_near) for x in self._tree.query(centers, n_near))
        places = np.concatenate([patches, centers[:, None]], axis=1)
        away = _from_each(places, self._corners[self._origins[rows]])
        nearest = away[:, 3].min(axis=1)
        at_least = np.clip(apart[:, -1] - self._reach, 0.0, nearest)
        # The distance from a triangle is convex: largest at a corner of the patch.
        return at_least, nearest, away.max(axis=1).min(axis=1)

    def are_within(
        self, points: NDArray[np.float64], radii: NDArray[np.float64]
    ) -> NDArray[np.bool_]:
        """Return which points (M, 3) have a triangle within radii (M,)."""
        farthest = float(radii.max(initial=0.0)) + self._reach
        apart, _ = self._tree.query(points, distance_upper_bound=farthest)
        # The center of a fragment is on it, and none of it is farther than its reach.
        within: NDArray[np.bool_] = apart <= radii
        unsure = np.flatnonzero(~within & (apart - self._reach <= radii))
        within[unsure] = self.nearest(points[unsure]) <= radii[unsure]
        return within

    def nearest(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the distances of points (M, 3) from the nearest triangles, (M,)."""
        found = np.empty(len(points))
        left, n_near = np.arange(len(points)), _FIRST
        while len(left) and n_near < len(self._corners):
            unsure = [left[:0]]
            for block in blocks(len(left), _MOST_PAIRS // n_near):
                some = left[block]
                apart, rows = self._tree.query(points[some], np.arange(1, n_near + 1))
                near = self._corners[self._origins[rows]]
                found[some] = _from_each(points[some, None], near).min(axis=(1, 2))
                # Fragments whose centers are farther away hold nothing nearer.
                unsure.append(some[found[some] > apart[:, -1] - self._reach])
            left, n_near = np.concatenate(unsure), 4 * n_near
        # By now, there are no more triangles than fragments to look at.
        for block in blocks(len(left), _MOST_PAIRS // len(self._corners)):
            some = left[block]
            every = np.broadcast_to(self._corners, (len(some), *self._corners.shape))
            found[some] = _from_each(points[some, None], every).min(axis=(1, 2))
        return found


def _from_each(
    places: NDArray[np.float64], targets: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return distances of places (N, P, 3) from triangles (N, K, 3, 3), (N, P, K)."""
    n, p, k = *places.shape[:2], targets.shape[1]
    away = distances_to(
        np.repeat(places.reshape(-1, 3), k, axis=0),
        np.repeat(targets, p, axis=0).reshape(-1, 3, 3),
    )
    return away.reshape(n, p, k)
