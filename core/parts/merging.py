"""Connected parts: specks join their neighbors, psi decides what else is merged."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ..geometry.face_graph import FaceGraph
from ..sight.pairs import PairTally

# As many parts as can be asked for; smaller pieces join others.
_MOST_PARTS = 256


def connected_parts(
    graph: FaceGraph, labels: NDArray[np.int64], smallest_area: float
) -> NDArray[np.int64]:
    """Return connected pieces as parts, each too small one given to a neighbor.

    Parameters
    ----------
    graph : FaceGraph
    labels : (P,) int
    smallest_area : float
        Pieces below this area join what they border on most.

    Returns
    -------
    parts : (P,) int
        0…K − 1, each used.
    """
    parts = _gathered(graph, labels, smallest_area)
    while True:
        areas = graph.areas_of(parts)
        order = np.argsort(-areas, kind="stable")
        small = areas < smallest_area
        small[order[_MOST_PARTS:]] = True
        small[order[0]] = False
        if not small.any():
            return parts
        joins = _joins_of_small(graph, parts, np.argsort(order), small)
        ties = sparse.coo_array(
            (np.ones(len(joins)), (np.arange(len(joins)), joins)),
            shape=(len(joins), len(joins)),
        )
        parts = connected_components(ties, directed=False)[1][parts].astype(np.int64)


def _gathered(
    graph: FaceGraph, labels: NDArray[np.int64], smallest_area: float
) -> NDArray[np.int64]:
    """Return connected pieces, those of a label that lie scattered and small as one."""
    pieces = graph.pieces(labels, smallest_area)
    areas = graph.areas_of(pieces)
    small = areas < smallest_area
    if not small.any():
        return pieces
    scattered = (small & graph.alone(pieces, len(areas)))[pieces]
    if not scattered.any():
        return pieces
    keys = np.where(scattered, len(areas) + labels, pieces)
    return np.unique(keys, return_inverse=True)[1].reshape(-1)


def _joins_of_small(
    graph: FaceGraph,
    parts: NDArray[np.int64],
    places: NDArray[np.int64],
    small: NDArray[np.bool_],
) -> NDArray[np.int64]:
    """Return for each part the one it joins: itself unless `small`.

    Only what comes earlier in the order of size, by `places`, takes a part in, so that
    no two swap; a part without neighbors joins the nearest one that has to join none.
    """
    joins = np.arange(len(places))
    borders = graph.borders(parts, len(places))
    alone = small & (np.diff(borders.indptr) == 0)
    for part in np.flatnonzero(small & ~alone):
        row = slice(borders.indptr[part], borders.indptr[part + 1])
        others, lengths = borders.indices[row], borders.data[row]
        larger = places[others] < places[part]
        if larger.any():
            joins[part] = others[larger][lengths[larger].argmax()]
    if alone.any():
        mine, others = np.flatnonzero(alone[parts]), np.flatnonzero(~small[parts])
        distances, nearest = cKDTree(graph.centers[others]).query(graph.centers[mine])
        # The last assignment of each part is that of its nearest polygon.
        order = np.argsort(-distances, kind="stable")
        joins[parts[mine[order]]] = parts[others[nearest[order]]]
    return joins


def merge_to(
    n_parts: int, tally: PairTally, touching: NDArray[np.bool_], alpha: float
) -> NDArray[np.int64]:
    """Merge parts two by two, at the least loss of psi, until few enough are left.

    Parameters
    ----------
    n_parts : int
        How many to keep.
    tally : PairTally
        Of K parts.
    touching : (K, K) bool
        Parts that do not touch are merged only when no two touch any more.
    alpha : float
        Of psi.

    Returns
    -------
    merged : (K,) int
        New part 0…`n_parts` − 1 of each old one.
    """
    merged = np.arange(len(touching))
    touching = touching.copy()
    while len(touching) > max(n_parts, 1):
        gains = tally.merge_gains(alpha)
        if touching.any():
            gains[~touching] = -np.inf
        kept, gone = sorted(divmod(int(gains.argmax()), len(gains)))
        tally = tally.merged(kept, gone)
        touching[kept] |= touching[gone]
        touching[:, kept] |= touching[:, gone]
        touching[kept, kept] = False
        touching = np.delete(np.delete(touching, gone, axis=0), gone, axis=1)
        merged[merged == gone] = kept
        merged[merged > gone] -= 1
    return merged
