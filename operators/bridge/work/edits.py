"""The edits of parts, as `editing.edit_object` takes them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ....core.errors import DecompositionError
from ....core.steps.progress import Progress, Steps, within
from ..parts.present_parts import PresentParts
from ..rays.bvh import BvhRayCaster

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ....core.parts.editing import Change
    from ....core.sight.prepared import Shape
    from ....core.sight.visibility import Visibility
    from .editing import MakeChange


def merging(chosen: Sequence[int], into: int) -> MakeChange:
    """Return the edit that makes one part of several."""

    def change(_: Shape, __: Visibility, parts: PresentParts) -> Steps[Change]:
        from ....core.parts.editing import merge

        yield Progress("Merge", 0.0)
        return merge(parts.labels, chosen, into)

    return change


def giving(faces: NDArray[np.bool_], part: int) -> MakeChange:
    """Return the edit that gives faces to a part, or raise if there are none."""
    if not faces.any():
        raise DecompositionError("No face is selected; select those to be assigned.")

    def change(_: Shape, __: Visibility, parts: PresentParts) -> Steps[Change]:
        from ....core.parts.editing import give

        yield Progress("Assign", 0.0)
        return give(parts.labels, faces, part)

    return change


def splitting(chosen: Sequence[int], n_parts: int) -> MakeChange:
    """Return the edit that splits each of some parts into so many, 0 for by psi."""

    def change(shape: Shape, _: Visibility, parts: PresentParts) -> Steps[Change]:
        from ....core.decomposition import decompose
        from ....core.parts.editing import Change

        labels, ranks = parts.labels.copy(), {}
        free = len(parts.identities)
        parameters = replace(parts.parameters, parts=n_parts, levels=1)
        for turn, part in enumerate(chosen):
            members = parts.labels == part
            found = yield from within(
                decompose(shape, parameters, BvhRayCaster, members),
                turn / len(chosen),
                (turn + 1) / len(chosen),
            )
            # The largest piece goes on as the part that it was.
            numbers = np.array([part, *range(free, free + found.n_parts - 1)])
            labels[members] = numbers[found.labels]
            ranks |= dict(zip(numbers.tolist(), found.ranks.tolist(), strict=True))
            free += found.n_parts - 1
        if free == len(parts.identities):
            raise _nothing_split(parts.identities[chosen[0]].name, n_parts)
        return Change(labels, ranks)

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

    def change(_: Shape, seen: Visibility, parts: PresentParts) -> Steps[Change]:
        from ....core.parts.editing import Change
        from ....core.parts.seam_smoothing import smooth_seams

        nodes = seen.form.labels_of_nodes(parts.labels)
        surface = seen.transfer.surface
        smoothed = yield from smooth_seams(surface, nodes, chosen, smoothness)
        return Change(smoothed[seen.form.nodes])

    return change


def mirroring(to_negative: bool) -> MakeChange:
    """Return the edit that copies the parts of one side of X to the other."""

    def change(shape: Shape, seen: Visibility, parts: PresentParts) -> Steps[Change]:
        from ....core.parts.editing import mirror

        nodes = seen.form.labels_of_nodes(parts.labels)
        found = yield from mirror(
            nodes,
            seen.transfer.surface,
            -float(shape.center[0]) / shape.diagonal,
            to_negative,
        )
        return replace(found, labels=found.labels[seen.form.nodes])

    return change
