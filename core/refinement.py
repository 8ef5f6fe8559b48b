"""Connected parts: specks join their neighbors, psi decides what else is merged."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from .convexity import PairTally
from .surface import Surface


def connected_parts(
    surface: Surface, labels: NDArray[np.int64], smallest_area: float
) -> NDArray[np.int64]:
    """Return connected pieces as parts, each too small one given to a neighbor.

    Parameters
    ----------
    surface : Surface
    labels : (P,) int
    smallest_area : float
        Pieces below this area join what they border on most.

    Returns
    -------
    parts : (P,) int
        0…K − 1, each used.
    """
    parts = surface.pieces(labels)
    while True:
        areas = surface.areas_of(parts)
        if len(areas) == 1 or areas.min() >= smallest_area:
            return parts
        joins = _joins_of_small(surface, parts, areas, smallest_area)
        graph = sparse.coo_array(
            (np.ones(len(joins)), (np.arange(len(joins)), joins)),
            shape=(len(joins), len(joins)),
        )
        parts = connected_components(graph, directed=False)[1][parts].astype(np.int64)


def _joins_of_small(
    surface: Surface,
    parts: NDArray[np.int64],
    areas: NDArray[np.float64],
    smallest_area: float,
) -> NDArray[np.int64]:
    """Return for each part the one it joins, itself when it is large enough."""
    joins = np.arange(len(areas))
    borders = surface.borders(parts, len(areas))
    small = np.flatnonzero(areas < smallest_area)
    isolated = []
    for part in small:
        row = slice(borders.indptr[part], borders.indptr[part + 1])
        others, lengths = borders.indices[row], borders.data[row]
        if len(others) == 0:
            isolated.append(part)
            continue
        # Only what is larger takes it in, so that no two parts swap places.
        grows = (areas[others] > areas[part]) | (
            (areas[others] == areas[part]) & (others > part)
        )
        if grows.any():
            joins[part] = others[grows][lengths[grows].argmax()]
    for part in isolated:
        joins[part] = _nearest_part(surface, parts, part)
    return joins


def _nearest_part(surface: Surface, parts: NDArray[np.int64], part: int) -> int:
    """Return the part that comes nearest to a part without neighbors."""
    mine, others = np.flatnonzero(parts == part), np.flatnonzero(parts != part)
    distances, nearest = cKDTree(surface.centers[others]).query(surface.centers[mine])
    return int(parts[others[nearest[distances.argmin()]]])


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
