"""The shells of a shape as its parts, such as the boards of a shelf.

Where one shell enters another there is no edge, so that seams have no crease to run in.
Lines of sight alone cut a patch off one of them there, or one side of a rod. People
seldom do: each was made as one thing.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...steps.arrays import IntArray
from ..part_psi import count_parts
from ..partition import Partitioner
from .pieces import connected_parts, merge_to

# Shells with fewer samples are not told from those beside them by what they see.
_FEW_SAMPLES = 10


def whole_shells(partitioner: Partitioner, most: int) -> IntArray | None:
    """Return the shells of a shape, those merged by whose merging psi gains.

    Parameters
    ----------
    partitioner : Partitioner
    most : int
        Largest number of parts.

    Returns
    -------
    (P,) int or None
        Part of each node: one shell or several; small shells join the nearest. None if
        there is one shell. Psi is counted from lines of sight alone.
    """
    shape, graph = partitioner.visibility.shape, partitioner.graph
    if shape.shells is None or not shape.shells.any():
        return None
    # Nodes that no ray meets, as doubled faces, have no shell. They join any neighbor.
    unknown = count_parts(shape.shells)
    shells = np.full(shape.n_nodes, unknown)
    shells[shape.targets.polygons] = shape.shells
    shells = partitioner.memo.on_patches(shells)
    areas = np.where(shells == unknown, 0.0, graph.areas)
    told = _FEW_SAMPLES / len(partitioner.visibility.samples) * areas.sum()
    least = max(partitioner.smallest_area, told)
    shells = connected_parts(replace(graph, areas=areas), shells, least)
    touching = graph.borders(shells, count_parts(shells)).toarray()
    tally, alpha = partitioner.tally_seen(shells), partitioner.parameters.alpha
    return merge_to(most, tally, touching, alpha, further=True)[shells]
