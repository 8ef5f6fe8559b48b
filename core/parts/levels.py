"""Parts decomposed again: what is small in a whole shape is large in its part.

The paper names small sharp concavities in a large convex context as its limit, such as
the fingers of a whole human (fig. 13c): few samples lie on them. Here each part gets as
many samples of its own, and is split where psi gains enough.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..parameters.parts import Parameters
from ..results import Decomposition
from ..sight.prepared import PreparedShape
from ..sight.visibility import Visibility, see_in_steps
from ..steps.progress import Steps, within, within_turn
from .find import by_size, describe, find_parts
from .part_memo import PartMemo

# A part is split if psi, from samples of its own, gains more than this. Most parts of
# a whole shape gain less.
_WORTH_SPLITTING = 0.25


def split_again(
    shape: PreparedShape,
    visibility: Visibility,
    found: Decomposition,
    parameters: Parameters,
) -> Steps[Decomposition]:
    """Split parts that are worth it, and their parts again, down to the last level.

    Parameters
    ----------
    shape : PreparedShape
    visibility : Visibility
        Of the shape.
    found : Decomposition
        Its parts on the first level.
    parameters : Parameters
        Whose `levels` counts the level that was found.

    Returns
    -------
    Steps of Decomposition
        Ranks of parts that were split are from their own samples.
    """
    finer = replace(parameters, parts=0, levels=parameters.levels - 1)
    labels, ranks = found.labels.copy(), found.ranks.tolist()
    for part in range(found.n_parts):
        members = found.labels == part
        steps = _pieces(shape.part(members), finer)
        pieces = yield from within_turn(steps, part, found.n_parts)
        if pieces is None:
            continue
        fresh = np.arange(pieces.n_parts - 1) + len(ranks)
        labels[members] = np.append(part, fresh)[pieces.labels]
        ranks[part], *others = pieces.ranks.tolist()
        ranks += others
    return _described(visibility, labels, np.array(ranks), parameters, found)


def _pieces(
    shape: PreparedShape, parameters: Parameters
) -> Steps[Decomposition | None]:
    """Return the parts of a part, None if it should stay whole."""
    visibility = yield from within(see_in_steps(shape, parameters), 0.0, 0.4)
    steps = find_parts(PartMemo(visibility), parameters)
    found = yield from within(steps, 0.4, 0.5)
    if found.psi - found.psi_before <= _WORTH_SPLITTING:
        return None
    if parameters.levels == 1:
        return found
    again = split_again(shape, visibility, found, parameters)
    return (yield from within(again, 0.5, 1.0))


def _described(
    visibility: Visibility,
    labels: NDArray[np.int64],
    ranks: NDArray[np.float64],
    parameters: Parameters,
    found: Decomposition,
) -> Decomposition:
    """Return the parts, the largest first, with the search of the first level."""
    nodes = visibility.shape.labels_of_nodes(labels)
    numbers = by_size(nodes, visibility.transfer.graph)[visibility.shape.nodes]
    _, first = np.unique(numbers, return_index=True)
    described = describe(visibility, numbers, parameters, found.psi_by_k, found.best_k)
    return replace(described, ranks=ranks[labels[first]], notes=found.notes)
