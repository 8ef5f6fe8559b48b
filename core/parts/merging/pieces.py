"""Makes parts connected, and merges parts: small pieces by area, others by psi."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ...geometry.graphs.components import components_at_once
from ...geometry.graphs.face_graph import FaceGraph
from ...parameters.parameter import field_of, info_of
from ...parameters.parts import Parameters
from ...sight.pair_tally import PairTally
from ...steps.arrays import BoolArray, IntArray

# If there are more pieces, the smallest ones join their neighbors.
_MOST_PARTS = int(info_of(field_of(Parameters, "parts")).high)


def connected_parts(
    graph: FaceGraph, labels: IntArray, smallest_area: float
) -> IntArray:
    """Cut labels into connected pieces, and give too small pieces to a neighbor.

    Parameters
    ----------
    graph : FaceGraph
    labels : (P,) int
    smallest_area : float
        A piece below this area joins the larger neighbor with the longest common
        border, in squared diagonals.

    Returns
    -------
    parts : (P,) int
        Part of each node, in 0…K − 1, each used.
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
        joining = np.flatnonzero(joins != np.arange(len(joins)))
        ties = np.stack([joining, joins[joining]], axis=1)
        parts = components_at_once(ties, len(joins))[parts]


def _gathered(graph: FaceGraph, labels: IntArray, smallest_area: float) -> IntArray:
    """Return connected pieces; small isolated pieces of one label count as one."""
    pieces = graph.pieces(labels, smallest_area)
    areas = graph.areas_of(pieces)
    small = areas < smallest_area
    if not small.any():
        return pieces
    scattered = (small & graph.alone(pieces, len(areas)))[pieces]
    if not scattered.any():
        return pieces
    keys = np.where(scattered, len(areas) + labels, pieces)
    return np.unique(keys, return_inverse=True)[1]


def _joins_of_small(
    graph: FaceGraph, parts: IntArray, places: IntArray, small: BoolArray
) -> IntArray:
    """Return the part that each part joins, (K,): itself unless it is `small`.

    `places` is the rank of each part by area, 0 for the largest. A part joins only
    larger neighbors, so that no two parts join each other. A part without neighbors
    joins the nearest part that is not small.
    """
    joins = np.arange(len(places))
    borders = graph.borders(parts, len(places))
    alone = small & (np.diff(borders.indptr) == 0)
    rows, others = np.repeat(joins, np.diff(borders.indptr)), borders.indices
    fit = np.flatnonzero(small[rows] & (places[others] < places[rows]))
    # By part, the longest border first. Of equal ones, the first.
    fit = fit[np.lexsort([-borders.data[fit], rows[fit]])]
    fit = fit[np.diff(rows[fit], prepend=-1) > 0]
    joins[rows[fit]] = others[fit]
    if alone.any():
        mine, others = np.flatnonzero(alone[parts]), np.flatnonzero(~small[parts])
        distances, nearest = cKDTree(graph.centers[others]).query(graph.centers[mine])
        # Assign in order of falling distance: the nearest polygon of a part is last.
        order = np.argsort(-distances, kind="stable")
        joins[parts[mine[order]]] = parts[others[nearest[order]]]
    return joins


def pieces_between(graph: FaceGraph, seams: BoolArray) -> IntArray:
    """Return the pieces that are left when a surface is cut along some edges.

    A crease that ends somewhere on the surface divides nothing. Shells that touch are
    one piece.

    Parameters
    ----------
    graph : FaceGraph
    seams : (E,) bool
        Which shared edges are cut.

    Returns
    -------
    (P,) int
        Piece of each polygon, in 0…K − 1.
    """
    ties = np.concatenate([graph.neighbors[~seams], graph.links])
    return components_at_once(ties, graph.n_polygons)


def merge_to(
    n_parts: int,
    tally: PairTally,
    borders: NDArray[Any],
    alpha: float,
    price: float = 0.0,
    *,
    further: bool = False,
) -> IntArray:
    """Merge pairs of parts, always the pair that loses least psi, down to `n_parts`.

    Parameters
    ----------
    n_parts : int
        Number of parts to keep, at most.
    tally : PairTally
        Counts of visible and known pairs of samples in K parts.
    borders : (K, K) float or bool
        Symmetric: the length of the border of each two parts, or whether they have one.
        One below 0 saves more than it costs. Without one they merge only if none touch.
    alpha : float
        Weight of hidden pairs in psi (eq. 5).
    price : float, optional
        What borders cost per length, in psi.
    further : bool, optional
        Merge further while borders save more than psi loses.

    Returns
    -------
    merged : (K,) int
        New part of each old part, in 0…K' − 1; K' is `n_parts` unless merged further.
    """
    merged = np.arange(len(borders))
    borders = borders.astype(np.float64)
    while len(borders) > 1:
        gains, touching = tally.merge_gains(alpha) + price * borders, borders != 0
        if touching.any():
            gains[~touching] = -np.inf
        saves = further and touching.any() and gains.max() > 0
        if len(borders) <= n_parts and not saves:
            break
        kept, gone = sorted(divmod(int(gains.argmax()), len(gains)))
        tally = tally.merged(kept, gone)
        borders[kept] += borders[gone]
        borders[:, kept] += borders[:, gone]
        borders[kept, kept] = 0.0
        borders = np.delete(np.delete(borders, gone, axis=0), gone, axis=1)
        merged[merged == gone] = kept
        merged[merged > gone] -= 1
    return merged
