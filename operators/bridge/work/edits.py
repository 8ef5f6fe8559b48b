"""Make the edits of parts that `run_edit.edit_object` runs."""

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
from .run_edit import MakeChange
from .session_cache import session_cache


def merging(chosen: Sequence[int], into: int) -> MakeChange:
    """Return the edit that merges parts into one.

    Parameters
    ----------
    chosen : sequence of int
        Parts to merge.
    into : int
        Part that they become.
    """

    def change(_: Shape, __: core.PartMemo, parts: PresentParts) -> Steps[core.Change]:
        yield Progress("Merge", 0.0)
        return core.give(parts.labels, np.isin(parts.labels, chosen), into)

    return change


def giving(faces: NDArray[np.bool_], part: int) -> MakeChange:
    """Return the edit that assigns faces to a part.

    Parameters
    ----------
    faces : (P,) bool
        Faces to assign.
    part : int

    Raises
    ------
    DecompositionError
        If there is no face to assign.
    """
    if not faces.any():
        raise DecompositionError("No face is selected; select the faces to assign.")

    def change(_: Shape, __: core.PartMemo, parts: PresentParts) -> Steps[core.Change]:
        yield Progress("Assign", 0.0)
        return core.give(parts.labels, faces, part)

    return change


def refreshing(_: Shape, __: core.PartMemo, parts: PresentParts) -> Steps[core.Change]:
    """Change no face: the parts are only measured and written again."""
    yield Progress("Refresh", 0.0)
    return core.Change(parts.labels)


def splitting(chosen: Sequence[int], n_parts: int) -> MakeChange:
    """Return the edit that splits each of some parts.

    Parameters
    ----------
    chosen : sequence of int
        Parts to split.
    n_parts : int
        Number of parts that each becomes; 0 lets psi decide.

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
        if free == len(parts.identities):
            raise _nothing_split(parts.identities[chosen[0]].name, n_parts)
        return core.Change(labels, ranks, by_hand=np.isin(parts.labels, chosen))

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

    Parameters
    ----------
    chosen : sequence of int
        Parts whose seams are smoothed.
    smoothness : float
        Weight lambda of the smoothness term (eq. 4).
    """

    def change(
        _: Shape, memo: core.PartMemo, parts: PresentParts
    ) -> Steps[core.Change]:
        shape = memo.visibility.shape
        nodes = shape.labels_of_nodes(parts.labels)
        smoothed = yield from core.smooth_seams(shape.graph, nodes, chosen, smoothness)
        return core.Change(smoothed[shape.nodes])

    return change


def mirroring(to_negative: bool) -> MakeChange:
    """Return the edit that copies the parts of one side of X to the other.

    Parameters
    ----------
    to_negative : bool
        Whether to copy from positive X to negative X, or the reverse.

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
