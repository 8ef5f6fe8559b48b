"""Finds the parts of a shape from its visibility."""

from __future__ import annotations

from dataclasses import replace

from ..parameters.parts import Parameters
from ..results.parts import Decomposition
from ..steps.one_thread import on_one_thread
from ..steps.progress import Steps, within
from .describe import by_size, describe, notes_on
from .fine_seams import labels_of_nodes, seams_take_long
from .merging.bends import with_bends_kept
from .part_count import PartCountSearch
from .part_memo import PartMemo
from .partition import Partitioner, count_parts
from .seams import SeamCutter


@on_one_thread
def find_parts(
    memo: PartMemo, parameters: Parameters, rough: bool = False
) -> Steps[Decomposition]:
    """Find the parts of a shape from its visibility.

    Parameters
    ----------
    memo : PartMemo
        The visibility, with results of earlier calls; new results are added.
    parameters : Parameters
        They may differ from the parameters of the visibility in settings that do not
        affect samples or lines of sight.
    rough : bool, optional
        Whether a first look at a large mesh is enough: seams may run along patches,
        and as many parts may be found as last time, if their number is not given.

    Returns
    -------
    Steps of Decomposition
        The steps yield `Progress`; `run` returns the decomposition.
    """
    visibility, cut = memo.visibility, memo.cut(parameters)
    yield from within(memo.transfer_in_steps(), 0.0, 0.2)
    partitioner = Partitioner(memo, parameters)
    search = PartCountSearch(
        partitioner,
        SeamCutter(partitioner, cut.seams),
        parameters.min_parts,
        parameters.max_parts,
        cut.searches,
    )
    wanted = search.given(parameters.parts) if parameters.parts else search.best()
    searched = (parameters.min_parts, parameters.max_parts) in cut.searches
    rough = rough and memo.patches is not None
    likely_k = parameters.parts or memo.latest_k
    guesses = rough and likely_k > 0 and not searched
    if parameters.bends == "KEEP":
        wanted = with_bends_kept(search, partitioner, parameters)
    elif guesses:
        wanted = search.guessed(likely_k)
    seams, psi_by_k, best_k = yield from within(wanted, 0.2, 0.9)
    rough = rough and (guesses or seams_take_long(memo, parameters, seams))
    if not parameters.parts:
        memo.latest_k = count_parts(seams.parts)
    finer = labels_of_nodes(memo, parameters, seams, rough)
    nodes = yield from within(finer, 0.9, 1.0)
    labels = by_size(nodes, visibility.shape.graph)[visibility.shape.nodes]
    found = describe(visibility, labels, parameters, psi_by_k, best_k)
    notes = notes_on(found, visibility, memo.transfer, parameters)
    return replace(found, notes=found.notes + notes, rough=rough)
