"""The edits of parts, as `editing.edit_object` takes them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .... import core
from ....core.errors import DecompositionError
from ....core.geometry.shape import Shape
from ....core.steps.progress import Progress, Steps, within_turn
from ..parts.present_parts import PresentParts
from .editing import MakeChange
from .session_cache import session_cache


def merging(chosen: Sequence[int], into: int) -> MakeChange:
    """Return the edit that makes one part of several."""

    def change(_: Shape, __: core.PartMemo, parts: PresentParts) -> Steps[core.Change]:
        yield Progress("Merge", 0.0)
        return core.merge(parts.labels, chosen, into)

    return change


def giving(faces: NDArray[np.bool_], part: int) -> MakeChange:
    """Return the edit that gives faces to a part, or raise if there are none."""
    if not faces.any():
        raise DecompositionError("No face is selected; select those to be assigned.")

    def change(_: Shape, __: core.PartMemo, parts: PresentParts) -> Steps[core.Change]:
        yield Progress("Assign", 0.0)
        return core.give(parts.labels, faces, part)

    return change


def splitting(chosen: Sequence[int], n_parts: int) -> MakeChange:
    """Return the edit that splits each of some parts into so many, 0 for by psi."""

    def change(
        shape: Shape, _: core.PartMemo, parts: PresentParts
    ) -> Steps[core.Change]:
        labels = parts.labels.copy()
        ranks: dict[int, float] = {}
        free = len(parts.identities)
        parameters = replace(parts.parameters, parts=n_parts, levels=1)
        for turn, part in enumerate(chosen):
            members = parts.labels == part
            steps = core.decompose_in_steps(shape, parameters, session_cache(), members)
            found = yield from within_turn(steps, turn, len(chosen))
            # The largest piece goes on as the part that it was.
            numbers = np.array([part, *range(free, free + found.n_parts - 1)])
            labels[members] = numbers[found.labels]
            ranks |= dict(zip(numbers.tolist(), found.ranks.tolist(), strict=True))
            free += found.n_parts - 1
        if free == len(parts.identities):
            raise _nothing_split(parts.identities[chosen[0]].name, n_parts)
        return core.Change(labels, ranks)

    return change


def _nothing_split(name: str, n_parts: int) -> DecompositionError:
    if n_parts:
        return DecompositionError(
            f"{name} has too few faces to be split; subdivide it, or choose another."
        )
    return DecompositionError(
        f"{name} stays whole: psi gains nothing by a split; give a number of parts to"
        " split it all the same."
    )


def smoothing(chosen: Sequence[int], smoothness: float) -> MakeChange:
    """Return the edit that smooths the seams of parts."""

    def change(
        _: Shape, memo: core.PartMemo, parts: PresentParts
    ) -> Steps[core.Change]:
        shape, graph = memo.visibility.shape, memo.visibility.transfer.graph
        nodes = shape.labels_of_nodes(parts.labels)
        smoothed = yield from core.smooth_seams(graph, nodes, chosen, smoothness)
        return core.Change(smoothed[shape.nodes])

    return change


def mirroring(to_negative: bool) -> MakeChange:
    """Return the edit that copies the parts of one side of X to the other."""

    def change(
        _: Shape, memo: core.PartMemo, parts: PresentParts
    ) -> Steps[core.Change]:
        shape, graph = memo.visibility.shape, memo.visibility.transfer.graph
        nodes = shape.labels_of_nodes(parts.labels)
        middle = -float(shape.center[0]) / shape.diagonal
        found = yield from core.mirror(nodes, graph, middle, to_negative)
        return replace(found, labels=found.labels[shape.nodes])

    return change
