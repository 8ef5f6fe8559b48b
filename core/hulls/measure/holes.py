"""Edges of holes: rays on either side of one cross different numbers of triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ...geometry.frames import cross_2d

# Longest of the short segments that edges of holes are divided into.
_GRAIN = 0.01
# Number of segments that are looked at. Among more, nothing is sure.
_NEIGHBORS = 24
# Segments that touch overlap by rounding, seen from a point, by less than this.
_TOUCHING = 1e-14


class HoleEdges:
    """The edges of the holes in a mesh, as short segments.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of the triangles, counter-clockwise seen from outside.
    """

    def __init__(self, corners: NDArray[np.float64]) -> None:
        edges = _open_edges(corners)
        starts, ways = edges[:, 0], edges[:, 1] - edges[:, 0]
        counts = np.ceil(np.linalg.norm(ways, axis=1) / _GRAIN).astype(np.int64)
        edge = np.repeat(np.arange(len(counts)), counts)
        rank = np.arange(len(edge)) - np.repeat(np.cumsum(counts) - counts, counts)
        shares = np.stack([rank, rank + 1], axis=1) / counts[edge, None]
        self._ends = starts[edge, None] + shares[..., None] * ways[edge, None]
        middles = self._ends.mean(axis=1)
        self._trees = [cKDTree(np.delete(middles, axis, axis=1)) for axis in range(3)]

    def surely_inside(
        self,
        points: NDArray[np.float64],
        radii: NDArray[np.float64],
        leaving: NDArray[np.int64],
    ) -> NDArray[np.bool_]:
        """Return in which regions most rays say that all of it is inside.

        Parameters
        ----------
        points : (M, 3) float
            Centers of the regions.
        radii : (M,) float
            No point of a region is farther from its center.
        leaving : (3, 2, M) int
            How many more triangles rays from the centers leave than enter: for each
            axis, rays against it and along it.

        Returns
        -------
        (M,) bool
        """
        near = np.stack([self._is_near(axis, points, radii) for axis in range(3)])
        # Where no edge is near, rays from elsewhere say what those from the center do.
        votes = ((leaving > 0).sum(axis=1) * ~near).sum(axis=0)
        for axis in range(3):
            open_votes = 2 * near[axis:].sum(axis=0)
            rows = np.flatnonzero(near[axis] & (votes <= 3) & (votes + open_votes > 3))
            losses = self._losses(axis, points[rows], radii[rows])
            votes[rows] += (leaving[axis][:, rows] > losses).sum(axis=0)
        return votes > 3

    def _is_near(
        self, axis: int, points: NDArray[np.float64], radii: NDArray[np.float64]
    ) -> NDArray[np.bool_]:
        """Return beside which regions, seen along an axis, edges of holes are, (M,)."""
        if len(self._ends) == 0 or len(points) == 0:
            return np.zeros(len(points), dtype=bool)
        reach = radii + _GRAIN / 2
        flat = np.delete(points, axis, axis=1)
        away = self._trees[axis].query(flat, distance_upper_bound=reach.max())[0]
        return away <= reach

    def _losses(
        self, axis: int, points: NDArray[np.float64], radii: NDArray[np.float64]
    ) -> NDArray[np.int64]:
        """Return how much less often rays may leave the mesh from elsewhere in regions.

        That is, leave it more often than they enter it, less than from the center:
        (2, M), for rays against the axis, and along it, at most so much.
        """
        found = np.zeros((2, len(points)), dtype=np.int64)
        if len(points) == 0:
            return found
        reach, ranks = radii + _GRAIN / 2, range(1, _NEIGHBORS + 1)
        flat = np.delete(points, axis, axis=1)
        away, rows = self._trees[axis].query(
            flat, ranks, distance_upper_bound=reach.max()
        )
        near = away <= reach[:, None]
        few = ~near[:, -1]
        found[:, ~few] = len(self._ends)
        most = near[few].sum(axis=1).max(initial=0)
        near, rows, radii = near[few, :most], rows[few, :most], radii[few, None]
        ends = self._ends[np.where(near, rows, 0)] - points[few, None, None]
        heights = ends[..., axis].mean(axis=2)
        one, other = np.moveaxis(ends[..., [(axis + 1) % 3, (axis + 2) % 3]], 2, 0)
        near &= _from_origin(one, other) <= radii
        for way, (first, last) in enumerate([(other, one), (one, other)]):
            passed = near & ((2 * way - 1) * heights > -radii - _GRAIN / 2)
            found[way, few] = _most_crossed(first, last, passed)
        return found


def _most_crossed(
    starts: NDArray[np.float64], ends: NDArray[np.float64], passed: NDArray[np.bool_]
) -> NDArray[np.int64]:
    """Return how many segments a way from the origin crosses to their right, at most.

    Each of M rows has K segments (M, K, 2) and which of them count, (M, K). Those that
    the origin is left of run around it; where the most of them overlap, one starts.
    """
    counts = passed & (cross_2d(starts, ends) > 0)
    begins = starts[:, :, None]
    over = (cross_2d(starts[:, None], begins) >= 0) & (
        cross_2d(begins, ends[:, None]) > _TOUCHING
    )
    crossed = (over & counts[:, None]).sum(axis=2)
    most: NDArray[np.int64] = np.where(counts, crossed, 0).max(axis=1, initial=0)
    return most


def _from_origin(
    starts: NDArray[np.float64], ends: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the distances of segments (M, K, 2) from the origin, (M, K)."""
    ways = ends - starts
    squares = np.maximum((ways**2).sum(axis=2), 1e-30)
    shares = np.clip(-(starts * ways).sum(axis=2) / squares, 0.0, 1.0)
    distances: NDArray[np.float64] = np.linalg.norm(
        starts + shares[..., None] * ways, axis=2
    )
    return distances


def _open_edges(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the edges that triangles run along more often one way, (E, 2, 3).

    They run that way, and come as often as it is more often.
    """
    places, rows = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    tails = rows.reshape(-1, 3)
    heads = tails[:, [1, 2, 0]]
    lower, higher = np.minimum(tails, heads), np.maximum(tails, heads)
    edges, edge_of = np.unique(lower * len(places) + higher, return_inverse=True)
    upwards = np.bincount(edge_of.ravel(), np.sign(heads - tails).ravel())
    ends = np.stack(np.divmod(edges, len(places)), axis=1)
    ends = np.where(upwards[:, None] < 0, ends[:, ::-1], ends)
    return places[np.repeat(ends, np.abs(upwards).astype(np.int64), axis=0)]
