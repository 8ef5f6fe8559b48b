"""Parts decomposed again: what is small in the whole shape is large in its part.

The paper's limit of small sharp concavities, such as the fingers of a whole human (its
fig. 13c): few samples are on them. Each part gets as many samples of its own.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..parameters.parts import Parameters
from ..sight.prepared import Shape
from ..sight.ray_march import MakeCaster
from ..sight.visibility import Visibility, see
from ..steps.progress import Steps, within
from .find import Decomposition, by_size, describe, find_parts

# A part is split where psi gains this much, on samples of its own: most parts of a
# whole shape gain less.
_WORTH_SPLITTING = 0.25


def split_again(
    shape: Shape,
    visibility: Visibility,
    found: Decomposition,
    parameters: Parameters,
    make_caster: MakeCaster,
    members: NDArray[np.bool_],
) -> Steps[Decomposition]:
    """Split parts that are worth it, and their parts in turn, down to the last level.

    Parameters
    ----------
    shape : TriangleMesh or PointCloud
    visibility : Visibility
        Of the members.
    found : Decomposition
        Of the members, in their order.
    parameters : Parameters
        Its levels count the one that is found.
    make_caster : callable
        As in `visibility.look`, whose errors are raised.
    members : (P,) bool
        Polygons, or points, that are decomposed.

    Returns
    -------
    Steps of Decomposition
        Of the members; ranks of parts that were split are from their own samples.
    """
    finer = replace(parameters, parts=0, levels=parameters.levels - 1)
    labels, ranks = found.labels.copy(), found.ranks.tolist()
    for part in range(found.n_parts):
        of_part = members.copy()
        of_part[members] = found.labels == part
        steps = _pieces(shape, of_part, finer, make_caster)
        begin, end = part / found.n_parts, (part + 1) / found.n_parts
        pieces = yield from within(steps, begin, end)
        if pieces is None:
            continue
        fresh = np.arange(pieces.n_parts - 1) + len(ranks)
        labels[found.labels == part] = np.append(part, fresh)[pieces.labels]
        ranks[part], *others = pieces.ranks.tolist()
        ranks += others
    return _described(visibility, labels, np.array(ranks), parameters, found)


def _pieces(
    shape: Shape,
    members: NDArray[np.bool_],
    parameters: Parameters,
    make_caster: MakeCaster,
) -> Steps[Decomposition | None]:
    """Return the parts of a part, None if it had better stay whole."""
    looked = see(shape, parameters, make_caster, members)
    visibility = yield from within(looked, 0.0, 0.4)
    found = yield from within(find_parts(visibility, parameters), 0.4, 0.5)
    if found.psi - found.psi_before <= _WORTH_SPLITTING:
        return None
    if parameters.levels == 1:
        return found
    again = split_again(shape, visibility, found, parameters, make_caster, members)
    return (yield from within(again, 0.5, 1.0))


def _described(
    visibility: Visibility,
    labels: NDArray[np.int64],
    ranks: NDArray[np.float64],
    parameters: Parameters,
    found: Decomposition,
) -> Decomposition:
    """Return the parts, the largest first, with what is told of those on top."""
    form, surface = visibility.form, visibility.transfer.surface
    nodes = form.labels_of_nodes(labels)
    numbers = by_size(nodes, surface)[form.nodes]
    _, first = np.unique(numbers, return_index=True)
    described = describe(visibility, numbers, parameters, found.psi_by_k, found.best_k)
    return replace(described, ranks=ranks[labels[first]], notes=found.notes)
