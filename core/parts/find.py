"""Finds the parts of a shape from its visibility.

`PartCountSearch.best` finds them if no number is given:

1. `tried`: find candidates for 2 to 13 parts, and for more while psi still rises.
2. `rated`: count psi by lines of sight alone; choose the fewest that are good enough.
3. `seams.cut`: smooth the seams of these parts.
4. `creases.better`: or cut along creases, or not at all, if that is better.

`given` starts with the same search. If it chose another number, its parts are split or
merged, and compete with the candidate for the number that is given. `guess` takes the
candidate for a likely number, without the search, and smooths roughly.
`with_bends_kept` merges what `best` or `given` found across bends, and asks `given` for
more parts until enough are left.
"""

from __future__ import annotations

from dataclasses import replace

from ..parameters.parts import Parameters
from ..results.parts import Decomposition
from ..steps.one_thread import on_one_thread
from ..steps.progress import Steps, within
from .describe import by_size, describe, notes_on
from .first_look import guess, likely_number
from .merging.bends import with_bends_kept
from .part_count import PartCountSearch
from .part_count_given import given, knows
from .part_memo import PartMemo
from .partition import Partitioner
from .seams.fine import parts_of_nodes, seams_take_long


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
        Whether a first look is enough, if the parts themselves would take long. If
        their number is not given, it is the best of the parts that were tried last.
        Seams of a large mesh may run along patches.

    Returns
    -------
    Steps of Decomposition
    """
    yield from within(memo.transfer_in_steps(), 0.0, 0.2)
    partitioner = Partitioner(memo, parameters)
    search = PartCountSearch(partitioner)
    likely_k = parameters.parts or (likely_number(search) if rough else 0)
    guesses = rough and likely_k > 0 and not _is_quick(search, parameters.parts)
    if parameters.bends == "KEEP":
        guesses, wanted = False, with_bends_kept(search)
    elif guesses:
        wanted = guess(search, likely_k)
    else:
        wanted = given(search, parameters.parts) if parameters.parts else search.best()
    seams, psi_by_k, best_k = yield from within(wanted, 0.2, 0.85)
    if not guesses:
        _, memo.tried = yield from search.tried()
        seams = yield from within(search.seams.smoothed(seams), 0.85, 0.9)
    rough = rough and (guesses or seams_take_long(partitioner, seams))
    finer = parts_of_nodes(partitioner, seams, rough)
    nodes = yield from within(finer, 0.9, 1.0)
    labels = by_size(nodes, memo.visibility.shape)
    found = describe(memo.visibility, labels, parameters, psi_by_k, best_k)
    notes = found.notes + notes_on(found, partitioner)
    return replace(found, notes=notes, rough=rough)


def _is_quick(search: PartCountSearch, n_parts: int) -> bool:
    """Return whether parts are known, or for 0, the best number, nearly so."""
    return knows(search, n_parts) if n_parts else search.searched
