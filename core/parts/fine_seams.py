"""Carries parts from the patches of a large mesh to its polygons.

Seams between patches are ragged. They are cut once more where only the polygons along
them count on their own.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..geometry.face_graph import FaceGraph
from ..parameters.parts import Parameters
from ..steps.memo import Memo
from ..steps.progress import Progress, Steps, within_turn
from .part_memo import PartMemo
from .partition import Partitioner
from .seams import SeamCutter

# Most times that seams are cut: once more whenever one has reached a patch beyond those
# along it.
_ROUNDS = 3


def labels_of_nodes(
    memo: PartMemo, parameters: Parameters, parts: NDArray[np.int64]
) -> Steps[NDArray[np.int64]]:
    """Return the part of each node of a shape's graph.

    Parameters
    ----------
    memo : PartMemo
        The visibility, and the patches of a large graph.
    parameters : Parameters
    parts : (G,) int
        Part of each patch, or of each node if there are no patches.

    Returns
    -------
    Steps of (P,) int
        `parts` itself without patches.
    """
    patches = memo.patches
    if patches is None:
        return parts
    by = Partitioner(memo, parameters)
    enough = by.psi(parts) - by.negligible
    labels, chosen = parts[patches.of_nodes], np.zeros(len(parts), dtype=bool)
    along = _along_seams(patches.coarse, parts)
    for turn in range(_ROUNDS):
        chosen[along] = True
        yield Progress("Seams", turn / _ROUNDS)
        graph, places = patches.opened(chosen)
        yield Progress("Seams", (turn + 0.5) / _ROUNDS)
        on_nodes = yield from memo.on(graph, places[memo.visibility.nodes])
        start = np.zeros(graph.n_polygons, dtype=np.int64)
        start[places] = labels
        cutter = SeamCutter(Partitioner(on_nodes, parameters), Memo())
        cut = yield from within_turn(cutter.cut(start, enough), turn, _ROUNDS)
        labels, closed = cut[places], np.flatnonzero(~chosen)
        reached = _along_seams(graph, cut)
        along = closed[reached[reached < len(closed)]]
        if len(along) == 0:
            break
    return labels


def _along_seams(graph: FaceGraph, labels: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the nodes beside a node of another label."""
    ends = labels[graph.neighbors]
    return np.unique(graph.neighbors[ends[:, 0] != ends[:, 1]])
