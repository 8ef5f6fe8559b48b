"""Carries parts from the patches of a large mesh to its polygons.

Seams between patches are ragged. They are cut once more where only the polygons along
them count on their own.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..geometry.face_graph import FaceGraph
from ..geometry.patches import Patches
from ..parameters.parts import Parameters
from ..steps.memo import Memo
from ..steps.progress import Progress, Steps, within, within_turn
from .part_memo import PartMemo
from .partition import Partitioner, count_parts
from .seams import SeamCutter, Seams

# Most times that seams are cut: again if one has reached patches farther away.
_ROUNDS = 2
# Least smoothness: borders of patches are ragged.
_LEAST_SMOOTHNESS = 0.1


def labels_of_nodes(
    memo: PartMemo, parameters: Parameters, seams: Seams
) -> Steps[NDArray[np.int64]]:
    """Return the part of each node of a shape's graph.

    Parameters
    ----------
    memo : PartMemo
        The visibility, and the patches of a large graph.
    parameters : Parameters
        That the parts were found with.
    seams : Seams
        Parts of the patches, or of the nodes if there are no patches.

    Returns
    -------
    Steps of (P,) int
    """
    patches, parts = memo.patches, seams.parts
    if patches is None:
        return parts
    labels, chosen = parts[patches.of_nodes], np.zeros(len(parts), dtype=bool)
    if count_parts(parts) == 1:
        return labels
    by = Partitioner(memo, parameters)
    enough = by.psi(parts) - by.negligible
    same = max(seams.smoothness, _LEAST_SMOOTHNESS)
    parameters = replace(parameters, smoothness=same)
    neighbors, reached = patches.coarse.neighbors, _along_seams(patches.coarse, parts)
    for turn in range(_ROUNDS):
        chosen[reached] = True
        beside = chosen[neighbors].any(axis=1)
        chosen[neighbors[beside]] = True
        cutting = within_turn(
            _cut(memo, patches, parameters, labels, chosen, enough), turn, _ROUNDS
        )
        labels, reached = yield from cutting
        if len(reached) == 0:
            break
    return labels


def _cut(
    memo: PartMemo,
    patches: Patches,
    parameters: Parameters,
    labels: NDArray[np.int64],
    chosen: NDArray[np.bool_],
    enough: float,
) -> Steps[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Cut seams where the nodes of some patches count on their own.

    Return the labels of all nodes, and the other patches that a seam has reached.
    """
    yield Progress("Seams", 0.0)
    graph, places = patches.opened(chosen)
    nodes = places[memo.visibility.nodes]
    on_nodes = yield from within(memo.on(graph, nodes), 0.1, 0.3)
    start = np.zeros(graph.n_polygons, dtype=np.int64)
    start[places] = labels
    cutter = SeamCutter(Partitioner(on_nodes, parameters), Memo())
    cut = yield from within(cutter.cut(start, enough), 0.3, 1.0)
    closed = np.flatnonzero(~chosen)
    reached = _along_seams(graph, cut.parts)
    return cut.parts[places], closed[reached[reached < len(closed)]]


def _along_seams(graph: FaceGraph, labels: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the nodes beside a node of another label."""
    ends = labels[graph.neighbors]
    return np.unique(graph.neighbors[ends[:, 0] != ends[:, 1]])
