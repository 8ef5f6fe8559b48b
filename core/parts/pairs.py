"""Finds the pairs of parts that are mirror images of each other across X."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from ..geometry.graphs.face_graph import FaceGraph
from ..geometry.symmetry import Side
from ..steps.arrays import IntArray
from ..steps.progress import Steps
from .part_memo import PartMemo
from .part_psi import count_parts

Pairs: TypeAlias = tuple[tuple[int, int], ...]

# Two parts are a pair if this share of the area of each has its image on the other.
_ENOUGH = 0.7
# The mirror plane faces along X if this share of the way to mirror images does.
_ALONG = 0.95


def mirror_pairs(memo: PartMemo, labels: IntArray) -> Steps[Pairs]:
    """Find the pairs of parts that are mirror images of each other across X.

    Parts that cross the mirror plane have no partner. Shapes whose mirror plane does
    not face along X have no pairs: "left" and "right" would mean nothing.

    Parameters
    ----------
    memo : PartMemo
        Of the shape.
    labels : (P,) int
        Part of each polygon, or point, in 0…K − 1, each used.

    Returns
    -------
    Steps of tuple of (int, int)
        Each the part at larger X, then the other; by the first.
    """
    if count_parts(labels) < 2:
        return ()
    graph = (yield from memo.transfer_in_steps()).graph
    parts = memo.on_patches(memo.visibility.shape.labels_of_nodes(labels))
    sides = yield from memo.sides()
    fitting = [_pairs_of(side, graph, parts) for side in sides if _along_x(side, graph)]
    return tuple(sorted(fitting[0])) if fitting else ()


def _along_x(side: Side, graph: FaceGraph) -> bool:
    """Return whether polygons and their mirror images lie apart along X."""
    ways = np.abs(graph.centers[side.sources] - graph.centers[side.images])
    total = float(np.linalg.norm(ways, axis=1).sum())
    return total > 0 and float(ways[:, 0].sum()) >= _ALONG * total


def _pairs_of(side: Side, graph: FaceGraph, parts: IntArray) -> list[tuple[int, int]]:
    """Return the pairs among parts, by the polygons that one side's are matched to."""
    n_parts, areas = count_parts(parts), graph.areas
    shared = np.zeros((n_parts, n_parts))
    images, sources = side.images, side.sources
    np.add.at(shared, (parts[sources], parts[images]), areas[images])
    totals = np.bincount(parts, areas, n_parts)
    moments = np.bincount(parts, areas * graph.centers[:, 0], n_parts)
    found = []
    for source, image in np.argwhere(shared > 0).tolist():
        least = _ENOUGH * max(totals[source], totals[image])
        if source != image and shared[source, image] >= least:
            # The areas are not 0: of a large mesh, a small part may own no patch.
            left_first = (
                moments[source] / totals[source] > moments[image] / totals[image]
            )
            found.append((source, image) if left_first else (image, source))
    return found
