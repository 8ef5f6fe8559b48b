"""Further levels: splits the parts of a shape again, with new samples on each part.

The paper names its limit: sharp, small, local concavities in a large convex context
(fig. 13c), such as the fingers of a whole human. Few samples lie on them. Here each
part gets as many samples as the whole shape had, and is split if psi gains enough.
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

# A part is split if psi gains more than this, counted from samples on the part alone.
# Most parts of a whole shape gain less.
_WORTH_SPLITTING = 0.25


def split_again(
    shape: PreparedShape,
    visibility: Visibility,
    found: Decomposition,
    parameters: Parameters,
) -> Steps[Decomposition]:
    """Split each part for which psi gains enough, down to the last level.

    Parameters
    ----------
    shape : PreparedShape
    visibility : Visibility
        Visibility of `shape`.
    found : Decomposition
        Parts of `shape` on this level.
    parameters : Parameters
        `levels` is the number of levels, this one included.

    Returns
    -------
    Steps of Decomposition
        Convexity ranks of split parts are measured with the samples on the part alone.
        The steps yield `Progress`; `run` returns the decomposition.
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
    """Return the parts that a part is split into, None if it stays whole."""
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
    """Measure the parts, the largest first; psi by k is that of the first level."""
    nodes = visibility.shape.labels_of_nodes(labels)
    numbers = by_size(nodes, visibility.transfer.graph)[visibility.shape.nodes]
    _, first = np.unique(numbers, return_index=True)
    described = describe(visibility, numbers, parameters, found.psi_by_k, found.best_k)
    return replace(described, ranks=ranks[labels[first]], notes=found.notes)
