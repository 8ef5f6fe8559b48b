"""Further levels: the parts of a shape, split again with new samples on each part.

The paper names its limit: sharp, small, local concavities in a large convex context
(fig. 13c), such as the fingers of a whole human. Few samples lie on them. Here each
part gets as many samples as the whole shape had, and is split if psi gains enough.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..parameters.parts import Parameters
from ..results.parts import Decomposition
from ..sight.visibility import Visibility
from .describe import by_size, describe

# A part is split if psi gains more than this, counted from samples on the part alone.
# Most parts of a whole shape gain less.
_WORTH_SPLITTING = 0.25


def with_pieces(
    visibility: Visibility,
    found: Decomposition,
    pieces: Mapping[int, Decomposition],
    parameters: Parameters,
) -> tuple[Decomposition, NDArray[np.int64]]:
    """Split parts into their pieces where psi gains enough.

    Parameters
    ----------
    visibility : Visibility
        Visibility of the whole shape.
    found : Decomposition
        Its parts so far.
    pieces : mapping of int to Decomposition
        From some of these parts to the decomposition of the part alone.
    parameters : Parameters
        Only `alpha`, the weight in psi, is used.

    Returns
    -------
    found : Decomposition
        The parts and pieces by area, the largest first. Convexity ranks of pieces are
        measured with the samples on their part alone.
    fresh : (F,) int
        Which of them are pieces: the parts that the next level may split.
    """
    labels, ranks = found.labels.copy(), found.ranks.tolist()
    fresh: list[int] = []
    for part, split in pieces.items():
        if split.psi - split.psi_before > _WORTH_SPLITTING:
            numbers = [part, *range(len(ranks), len(ranks) + split.n_parts - 1)]
            labels[found.labels == part] = np.array(numbers)[split.labels]
            ranks[part], *others = split.ranks.tolist()
            ranks += others
            fresh += numbers
    nodes = visibility.shape.labels_of_nodes(labels)
    numbered = by_size(nodes, visibility.shape.graph)[visibility.shape.nodes]
    _, first = np.unique(numbered, return_index=True)
    before = labels[first]  # by the new number of each part
    described = describe(visibility, numbered, parameters, found.psi_by_k, found.best_k)
    own_ranks = np.array(ranks)[before]
    again = replace(described, ranks=own_ranks, notes=found.notes)
    return again, np.flatnonzero(np.isin(before, fresh))
