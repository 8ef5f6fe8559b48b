"""Make the edits of parts that `run_edit.edit_object` runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from .... import core
from ....core.errors import DecompositionError
from ....core.geometry.shape import Shape
from ....core.parameters.parameter import check, field_of
from ....core.parameters.parts import Parameters
from ....core.steps.arrays import BoolArray, IntArray
from ....core.steps.progress import Progress, Steps, within_turn
from ..parts.present_parts import PresentParts
from .run_edit import MakeChange
from .session_cache import session_cache


def merging(chosen: Sequence[int], into: int) -> MakeChange:
    """Return the edit that merges the chosen parts into one of them."""

    def merged(labels: IntArray) -> core.Change:
        return core.give(labels, np.isin(labels, chosen), into)

    return _at_once("Merge", merged)


def giving(faces: BoolArray, part: int) -> MakeChange:
    """Return the edit that assigns faces, (P,), to a part.

    Raises
    ------
    DecompositionError
        If there is no face to assign.
    """
    if not faces.any():
        raise DecompositionError("No face is selected; select the faces to assign.")
    return _at_once("Assign", lambda labels: core.give(labels, faces, part))


def refreshing() -> MakeChange:
    """Return the edit of no face: parts are only measured and written again."""
    return _at_once("Refresh", lambda labels: core.Change(labels))


def _at_once(stage: str, edit: Callable[[IntArray], core.Change]) -> MakeChange:
    """Return an edit that takes the labels of faces, (P,), and no time."""

    def change(_: Shape, __: core.PartMemo, parts: PresentParts) -> Steps[core.Change]:
        yield Progress(stage, 0.0)
        return edit(parts.labels)

    return change


def splitting(chosen: Sequence[int], n_parts: int) -> MakeChange:
    """Return the edit that splits each of some parts into `n_parts`; 0 lets psi decide.

    Raises
    ------
    DecompositionError
        In its steps, if no part was split.
    """

    def change(
        shape: Shape, _: core.PartMemo, parts: PresentParts
    ) -> Steps[core.Change]:
        labels = parts.labels.copy()
        ranks: dict[int, float] = {}
        notes: list[str] = []
        free = len(parts.identities)
        parameters = replace(parts.parameters, parts=n_parts, levels=1)
        for turn, part in enumerate(chosen):
            members = parts.labels == part
            steps = core.decompose_in_steps(shape, parameters, session_cache(), members)
            found = yield from within_turn(steps, turn, len(chosen))
            # The largest new part keeps the number of the part that was split.
            numbers = np.array([part, *range(free, free + found.n_parts - 1)])
            labels[members] = numbers[found.labels]
            ranks |= dict(zip(numbers.tolist(), found.ranks.tolist(), strict=True))
            free += found.n_parts - 1
            short = core.notes_on_count(parameters, max(found.psi_by_k))
            notes += [f"{parts.identities[part].name}: {each}" for each in short]
        if free == len(parts.identities):
            raise _nothing_split(parts.identities[chosen[0]].name, n_parts)
        by_hand = np.isin(parts.labels, chosen)
        return core.Change(labels, ranks, by_hand=by_hand, notes=tuple(notes))

    return change


def _nothing_split(name: str, n_parts: int) -> DecompositionError:
    """Return the error for an edit that split no part."""
    if n_parts:
        return DecompositionError(
            f"{name} has too few faces to be split; subdivide it, or choose another."
        )
    return DecompositionError(
        f"{name} was not split, because a split would not raise psi; set a number of"
        " parts to split it anyway."
    )


def smoothing(chosen: Sequence[int], smoothness: float) -> MakeChange:
    """Return the edit that smooths the seams of parts.

    `smoothness` is the weight lambda of the smoothness term (eq. 4).

    Raises
    ------
    DecompositionError
        If it is no number, or out of bounds.
    """
    check(field_of(Parameters, "smoothness"), smoothness)

    def change(
        _: Shape, memo: core.PartMemo, parts: PresentParts
    ) -> Steps[core.Change]:
        shape = memo.visibility.shape
        nodes = shape.labels_of_nodes(parts.labels)
        smoothed = yield from core.smooth_seams(shape.graph, nodes, chosen, smoothness)
        return core.Change(smoothed[shape.nodes])

    return change


def mirroring(to_negative: bool) -> MakeChange:
    """Return the edit that copies the parts at positive X to negative X, or back.

    Raises
    ------
    DecompositionError
        In its steps, if the shape is not symmetric.
    """

    def change(
        _: Shape, memo: core.PartMemo, parts: PresentParts
    ) -> Steps[core.Change]:
        shape = memo.visibility.shape
        nodes = shape.labels_of_nodes(parts.labels)
        middle = -float(shape.center[0]) / shape.diagonal
        found = yield from core.mirror(nodes, shape.graph, middle, to_negative)
        return replace(found, labels=found.labels[shape.nodes])

    return change
