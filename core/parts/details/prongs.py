"""Finds the prongs of parts, such as the fingers of an arm, from the surface alone.

Few samples of a whole shape lie on a finger, so that psi does not find it. But an arm
without fingers has one tip, and an arm with fingers has five: places that are farther
from the rest of the shape than all around them. To see them takes no ray.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from ...geometry.face_graph import FaceGraph
from ...steps.progress import Progress, Steps

# A prong is long if its squared length is at least this share of its area. A cylinder
# has that share if it is 2.5 times as long as its radius; a heel has less.
_LONG = 0.4
# Least length of a prong, as a share of the largest distance from the part's seams, and
# number of its nodes: smaller ones are roughness.
_LEAST_LENGTH = 0.03
_LEAST_NODES = 6


def find_tips(
    graph: FaceGraph, parts: NDArray[np.int64], chosen: NDArray[np.bool_]
) -> Steps[NDArray[np.int64]]:
    """Return the tips of the prongs of some parts.

    Seen from the tips, distances from the part's seams fall until two prongs meet. The
    shorter one ends there, and so has a length and an area. If it is long, both count.
    A part without seams has no prongs.

    Parameters
    ----------
    graph : FaceGraph
    parts : (P,) int
        Part of each node, in 0…K − 1.
    chosen : (K,) bool
        Parts to look at.

    Returns
    -------
    Steps of (T,) int
        Different nodes, ascending; at least two of each part that has prongs.
    """
    ends = graph.neighbors
    at_seams = np.zeros(len(parts), dtype=bool)
    at_seams[ends[parts[ends[:, 0]] != parts[ends[:, 1]]]] = True
    kept = np.flatnonzero(chosen[parts])
    if not at_seams[kept].any():
        return kept[:0]
    some, parts = graph.part(kept), parts[kept]
    ends = some.neighbors
    pairs = ends[parts[ends[:, 0]] == parts[ends[:, 1]]]
    far = _distances(some, pairs, np.flatnonzero(at_seams[kept]))
    yield Progress("Details", 0.5)
    reach = np.zeros(len(chosen))
    np.maximum.at(reach, parts, far)
    hills, saddles = _hills(far, pairs)
    least = _LEAST_LENGTH * reach[parts]
    return kept[_long_prongs(far, some.areas, hills, saddles, least)]


def _hills(
    far: NDArray[np.float64], pairs: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the top that each node climbs to, (P,), and where hills meet, (S, 3).

    These are two tops and the node between them, the highest ones first.
    """
    order = np.argsort(far, kind="stable")
    ranks = np.empty_like(order)
    ranks[order] = np.arange(len(order))
    higher = ranks.copy()
    for one, other in (pairs.T, pairs.T[::-1]):
        np.maximum.at(higher, one, ranks[other])
    hills = order[higher]
    while (hills[hills] != hills).any():
        hills = hills[hills]
    ends = np.sort(hills[pairs], axis=1)
    levels = ranks[pairs].min(axis=1)
    rows = np.flatnonzero(ends[:, 0] != ends[:, 1])
    rows = rows[np.argsort(-levels[rows], kind="stable")]
    first = np.sort(np.unique(ends[rows], axis=0, return_index=True)[1])
    rows = rows[first]
    return hills, np.column_stack([ends[rows], order[levels[rows]]])


def _long_prongs(
    far: NDArray[np.float64],
    areas: NDArray[np.float64],
    hills: NDArray[np.int64],
    saddles: NDArray[np.int64],
    least: NDArray[np.float64],
) -> NDArray[np.int64]:
    """Return the tips of prongs that are long where they meet another, ascending."""
    tips = hills.copy()  # of the prong that each hill belongs to by now
    found = set()
    for one, other, saddle in saddles.tolist():
        short, long = sorted((tips[one], tips[other]), key=far.__getitem__)
        length = far[short] - far[saddle]
        if short == long:
            continue
        if length > least[short]:
            beyond = np.flatnonzero((tips[hills] == short) & (far > far[saddle]))
            is_long = length**2 >= _LONG * areas[beyond].sum()
            if is_long and len(beyond) >= _LEAST_NODES:
                found |= {int(short), int(long)}
        tips[tips == short] = long
    return np.array(sorted(found), dtype=np.int64)


def _distances(
    graph: FaceGraph, pairs: NDArray[np.int64], starts: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return how far nodes are from the nearest start, along pairs; 0 without a way."""
    ways = np.linalg.norm(np.subtract(*graph.centers[pairs.T]), axis=1)
    ways = np.maximum(ways, np.finfo(float).tiny)  # 0 would mean no way
    size = graph.n_polygons, graph.n_polygons
    roads = sparse.csr_array((ways, tuple(pairs.T)), shape=size)
    far = dijkstra(roads, directed=False, indices=starts, min_only=True)
    return np.where(np.isfinite(far), far, 0.0)
