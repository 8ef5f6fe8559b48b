"""Edges of holes: rays on either side of one cross different numbers of triangles."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ...geometry.frames import cross_2d
from ...geometry.welding import distinct_points
from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.rows import ranges
from .line_crossings import as_seen

# Longest of the short segments that edges of holes are divided into.
_GRAIN = 0.01
# Number of segments that are looked at. Among more, nothing is sure.
_NEIGHBORS = 24
# Distance between what rays along different axes see; the longest side is 2.
_APART = 100.0
# Segments that touch overlap by rounding, seen from a point, by less than this.
_TOUCHING = 1e-14


class HoleEdges:
    """The edges of the holes in a mesh, as short segments.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of the triangles, counter-clockwise seen from outside.
    """

    def __init__(self, corners: FloatArray) -> None:
        edges = _open_edges(corners)
        starts, ways = edges[:, 0], edges[:, 1] - edges[:, 0]
        counts = np.ceil(np.linalg.norm(ways, axis=1) / _GRAIN).astype(np.int64)
        edge, rank = ranges(counts)
        shares = np.stack([rank, rank + 1], axis=1) / counts[edge, None]
        ends = starts[edge, None] + shares[..., None] * ways[edge, None]
        # The segments three times, as rays along each axis see them.
        self._ends = as_seen(ends).reshape(-1, 2, 3)
        axes = np.repeat(np.arange(3), len(ends))
        self._tree = cKDTree(_spots_of(axes, self._ends.mean(axis=1)))

    def surely_inside(
        self, points: FloatArray, radii: FloatArray, leaving: IntArray
    ) -> BoolArray:
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
        turned = as_seen(points)
        near = self._are_near(turned, radii)
        # Where no edge is near, rays from elsewhere say what those from the center do.
        votes = ((leaving > 0).sum(axis=1) * ~near).sum(axis=0)
        unsure = (votes <= 3) & (votes + 2 * near.sum(axis=0) > 3)
        axes, rows = np.nonzero(near & unsure)
        more = self._votes(
            axes, turned[axes, rows], radii[rows], leaving[axes, :, rows]
        )
        np.add.at(votes, rows, more)
        return votes > 3

    def _are_near(self, turned: FloatArray, radii: FloatArray) -> BoolArray:
        """Return beside which regions, seen along an axis, edges of holes are, (3, M).

        `turned` (3, M, 3) are the centers of regions as rays along each axis see them.
        """
        if len(self._ends) == 0 or len(radii) == 0:
            return np.zeros(turned.shape[:2], dtype=bool)
        reach = radii + _GRAIN / 2
        spots = _spots_of(np.repeat(np.arange(3), len(radii)), turned.reshape(-1, 3))
        away = self._tree.query(spots, distance_upper_bound=reach.max())[0]
        return away.reshape(3, -1) <= reach

    def _votes(
        self, axes: IntArray, turned: FloatArray, radii: FloatArray, leaving: IntArray
    ) -> IntArray:
        """Return how many of the two rays leave the mesh from all of a region, (M,).

        From elsewhere in a region, rays may leave the mesh less often than from the
        center: as often less as a way there crosses edges of holes. `turned` (M, 3) are
        the centers as rays along an axis each see them, `leaving` is (M, 2).
        """
        votes = np.zeros(len(turned), dtype=np.int64)
        if len(turned) == 0:
            return votes
        reach, ranks = radii + _GRAIN / 2, range(1, _NEIGHBORS + 1)
        away, segments = self._tree.query(
            _spots_of(axes, turned), ranks, distance_upper_bound=reach.max()
        )
        near = away <= reach[:, None]
        few = ~near[:, -1]
        # Pairs of a region and an edge near it.
        row, rank = np.nonzero(near & few[:, None])
        ends = self._ends[segments[row, rank]] - turned[row, None]
        met = _from_origin(ends[..., :2]) <= radii[row]
        row, rank, ends = row[met], rank[met], ends[met]
        heights, reach = ends[..., 2].mean(axis=1), reach[row]
        for way, side in enumerate((-1, 1)):
            flat = ends[:, ::side, :2]
            crossed = side * heights > -reach
            crossed &= cross_2d(flat[:, 0], flat[:, 1]) > 0
            pairs = row[crossed], rank[crossed], flat[crossed]
            votes += few & _leave_more(leaving[:, way], *pairs)
        return votes


def _spots_of(axes: IntArray, turned: FloatArray) -> FloatArray:
    """Return where rays along an axis each run, (M, 3), those of each axis far apart.

    `turned` (M, 3) are points as these rays see them.
    """
    return np.column_stack([turned[:, :2], _APART * axes])


def _leave_more(
    leaving: IntArray, row: IntArray, rank: IntArray, flat: FloatArray
) -> BoolArray:
    """Return where rays leave more often than a way through the region crosses edges.

    `flat` (P, 2, 2) are the edges that may be crossed to their right; `row` and `rank`
    (P,) tell which of M regions each is in, and its number there.
    """
    total = np.bincount(row, minlength=len(leaving))
    more = leaving > total
    unsure = ~more & (leaving > 1)  # one edge at least is crossed
    if unsure.any():
        asked = unsure[row]
        row, rank = (np.cumsum(unsure) - 1)[row[asked]], rank[asked]
        ends = np.zeros((unsure.sum(), rank.max() + 1, 2, 2))
        ends[row, rank] = flat[asked]
        more[unsure] = leaving[unsure] > _most_crossed(ends)
    return more


def _most_crossed(ends: FloatArray) -> IntArray:
    """Return how many segments a way from the origin crosses at most, (M,).

    Each row of `ends` (M, K, 2, 2) has segments that the origin is left of, and zeros.
    These run around it; where the most of them overlap, one starts.
    """
    starts, ends = ends[:, :, None, 0], ends[:, :, None, 1]
    begins = starts.swapaxes(1, 2)
    over = (cross_2d(starts, begins) >= 0) & (cross_2d(begins, ends) > _TOUCHING)
    return over.sum(axis=1).max(axis=1)


def _from_origin(segments: FloatArray) -> FloatArray:
    """Return the distances of segments (P, 2, 2) from the origin, (P,)."""
    starts, ways = segments[:, 0], segments[:, 1] - segments[:, 0]
    squares = np.maximum((ways**2).sum(axis=1), 1e-30)
    shares = np.clip(-(starts * ways).sum(axis=1) / squares, 0.0, 1.0)
    return np.linalg.norm(starts + shares[:, None] * ways, axis=1)


def _open_edges(corners: FloatArray) -> FloatArray:
    """Return the edges that triangles run along more often one way, (E, 2, 3).

    They run that way, and come as often as it is more often.
    """
    places, rows = distinct_points(corners.reshape(-1, 3))
    tails = rows.reshape(-1, 3)
    heads = tails[:, [1, 2, 0]]
    lower, higher = np.minimum(tails, heads), np.maximum(tails, heads)
    edges, edge_of = np.unique(lower * len(places) + higher, return_inverse=True)
    upwards = np.bincount(edge_of.ravel(), np.sign(heads - tails).ravel())
    ends = np.stack(np.divmod(edges, len(places)), axis=1)
    ends = np.where(upwards[:, None] < 0, ends[:, ::-1], ends)
    return places[np.repeat(ends, np.abs(upwards).astype(np.int64), axis=0)]
