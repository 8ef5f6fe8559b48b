"""Further levels: the parts of a shape, split again with new samples on each part.

The paper names its limit: sharp, small, local concavities in a large convex context
(fig. 13c), such as the fingers of a whole human. Few samples lie on them. Here a part
gets samples of its own, and is split if psi gains enough.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from ...parameters.parts import Parameters
from ...results.parts import Decomposition
from ...sight.prepared import PreparedShape
from ...steps.arrays import BoolArray, IntArray
from ...steps.progress import Progress, Steps, within, within_turn
from ..describe import by_size, describe
from ..find import find_parts
from ..part_memo import PartMemo
from .joints import cut_joints
from .prongs import find_tips

See: TypeAlias = Callable[[PreparedShape, Parameters], Steps[PartMemo]]

# A part is split if psi gains more than this, counted from samples on the part alone.
# Most parts of a whole shape gain less.
_WORTH_SPLITTING = 0.25
# With levels chosen automatically, these parts are looked at again: the samples on them
# do not see each other well, they have a small share of the area, and several prongs.
# Parts of a whole shape that see even less of themselves are hollow or crumpled.
_LEAST_RANK, _MOST_RANK = 0.3, 0.8
_MOST_AREA = 0.25
_FEWEST_PRONGS = 2
# A hand has five, and a body with fingers and toes twenty. More of them on a part, or
# on all such parts, are a texture, such as fur or feathers, and would take too long.
_MOST_OF_PART, _MOST_PRONGS = 12, 24
# There are so many further levels, such as arm, hand and finger, and each part is seen
# by so many samples and split into so many pieces at most.
_FURTHER_LEVELS = 3
_SAMPLES = 250
_MOST_PIECES = 7


def finds_details(parameters: Parameters) -> bool:
    """Return whether only parts that hide details are split further.

    Parameters
    ----------
    parameters : Parameters
        That is so if neither `levels` nor `parts` is given.
    """
    return parameters.levels == parameters.parts == 0


def split_further(
    memo: PartMemo,
    found: Decomposition,
    parameters: Parameters,
    see: See,
) -> Steps[Decomposition]:
    """Split parts once more, each seen by samples of its own.

    Parameters
    ----------
    memo : PartMemo
        Of the shape.
    found : Decomposition
        Its parts. A first look at them has no details.
    parameters : Parameters
        With 2 `levels` or more, all parts are split, and their pieces on each level.
        With 0 and no number of `parts`, only parts are whose prongs come apart so.
    see : callable
        Returns the steps that make the memo of a part.

    Returns
    -------
    Steps of Decomposition
        The parts that are left and the pieces, by area, the largest first. Convexity
        ranks of pieces are measured with the samples on their part alone.
    """
    if found.rough:
        return found
    if finds_details(parameters):
        yield Progress("Details", 0.0)
        steps = cut_joints(memo, found, parameters)
        found = yield from within(steps, 0.0, 0.1)
        few = replace(
            parameters,
            samples=min(parameters.samples, _SAMPLES),
            min_parts=Parameters.min_parts,
            max_parts=min(parameters.max_parts, _MOST_PIECES),
            containers="HOLLOW",  # limbs enclose nothing, and to find that out is slow
        )
        tips = yield from within(_tips_of(memo, found), 0.1, 0.2)
        steps = _split(memo, found, few, see, _FURTHER_LEVELS, tips)
        return (yield from within(steps, 0.2, 1.0))
    all_samples, n_levels = replace(parameters, parts=0), parameters.levels - 1
    return (yield from _split(memo, found, all_samples, see, n_levels))


def _split(
    memo: PartMemo,
    found: Decomposition,
    parameters: Parameters,
    see: See,
    n_levels: int,
    tips: BoolArray | None = None,
) -> Steps[Decomposition]:
    """Split parts on some further levels; with tips, only so far that they part."""
    if n_levels <= 0:
        return found
    chosen = np.arange(found.n_parts) if tips is None else _hiding(found, tips)
    shape, pieces = memo.visibility.shape, {}
    for turn, part in enumerate(chosen.tolist()):
        members = found.labels == part
        rest = None if tips is None else tips[members]
        steps = _split_part(shape.part(members), parameters, see, n_levels, rest)
        split = yield from within_turn(steps, turn, len(chosen))
        if split is not None and (rest is None or _come_apart(split, rest)):
            pieces[part] = split
    return _with_pieces(memo, found, pieces, parameters) if pieces else found


def _split_part(
    part: PreparedShape,
    parameters: Parameters,
    see: See,
    n_levels: int,
    tips: BoolArray | None,
) -> Steps[Decomposition | None]:
    """Return the pieces of a part, and theirs; None if psi gains little by them."""
    memo = yield from within(see(part, parameters), 0.0, 0.4)
    found = yield from within(find_parts(memo, parameters), 0.4, 0.5)
    if found.psi - found.psi_before <= _WORTH_SPLITTING:
        return None
    steps = _split(memo, found, parameters, see, n_levels - 1, tips)
    return (yield from within(steps, 0.5, 1.0))


def _hiding(found: Decomposition, tips: BoolArray) -> IntArray:
    """Return the parts that hide details: those with several prongs."""
    counts = np.bincount(found.labels[tips], minlength=found.n_parts)
    hiding = (counts >= _FEWEST_PRONGS) & (found.ranks < _MOST_RANK)
    return np.flatnonzero(hiding)


def _come_apart(found: Decomposition, tips: BoolArray) -> bool:
    """Return whether not all tips are on one piece."""
    return len(np.unique(found.labels[tips])) > 1


def _tips_of(memo: PartMemo, found: Decomposition) -> Steps[BoolArray]:
    """Return which polygons are the tips of prongs of small parts, (P,)."""
    tips = np.zeros(len(found.labels), dtype=bool)
    chosen = found.areas < _MOST_AREA * found.areas.sum()
    chosen &= (found.ranks > _LEAST_RANK) & (found.ranks < _MOST_RANK)
    shape = memo.visibility.shape
    if shape.plane is not None or not chosen.any():
        return tips
    graph = (yield from memo.transfer_in_steps()).graph
    parts = memo.on_patches(shape.labels_of_nodes(found.labels))
    at = yield from find_tips(graph, parts, chosen)
    at = at[np.bincount(parts[at], minlength=1)[parts[at]] <= _MOST_OF_PART]
    if len(at) <= _MOST_PRONGS:
        numbers = memo.off_patches(np.arange(graph.n_polygons))[shape.nodes]
        places, first = np.unique(numbers, return_index=True)
        tips[first[np.isin(places, at)]] = True
    return tips


def _with_pieces(
    memo: PartMemo,
    found: Decomposition,
    pieces: Mapping[int, Decomposition],
    parameters: Parameters,
) -> Decomposition:
    """Replace some parts by their pieces, of which each keeps its convexity rank."""
    labels, ranks = found.labels.copy(), found.ranks.tolist()
    for part, split in pieces.items():
        numbers = [part, *range(len(ranks), len(ranks) + split.n_parts - 1)]
        labels[found.labels == part] = np.array(numbers)[split.labels]
        ranks[part], *others = split.ranks.tolist()
        ranks += others
    shape = memo.visibility.shape
    numbered = by_size(shape.labels_of_nodes(labels), shape)
    _, first = np.unique(numbered, return_index=True)
    ks = found.psi_by_k, found.best_k
    described = describe(memo.visibility, numbered, parameters, *ks)
    own_ranks = np.array(ranks)[labels[first]]  # by the new number of each part
    return replace(described, ranks=own_ranks, notes=found.notes)
