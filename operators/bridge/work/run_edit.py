"""Edit the parts of an object: read it at once, compute in steps, then write."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import bpy
import numpy as np
from numpy.typing import NDArray

from .... import core
from ....core.geometry.shape import Shape
from ....core.parameters.parts import Parameters
from ....core.results import Decomposition
from ....core.steps.progress import Steps, within
from ..parts.present_parts import PresentParts, present_parts
from ..parts.write import check_writable, write_parts
from ..read.shape import read_shape, reading_notes
from ..stored.identity import Identity, identities_after, with_sides
from .libraries import load_libraries
from .session_cache import session_cache

MakeChange: TypeAlias = Callable[
    [Shape, "core.PartMemo", PresentParts], Steps["core.Change"]
]

# Two parts with a smaller relative difference of area count as the same faces.
_SAME_AREA = 1e-4


@dataclass(frozen=True, eq=False)
class Edited:
    """The parts of an object after an edit or a new decomposition.

    Attributes
    ----------
    decomposition : Decomposition
    identities : tuple of Identity or None
        Identity of each part, kept or new; None if all parts are new.
    parameters : Parameters
        Recorded on the object with the parts.
    """

    decomposition: Decomposition
    identities: tuple[Identity, ...] | None
    parameters: Parameters

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences to the user."""
        return self.decomposition.notes

    def write(self, obj: bpy.types.Object) -> None:
        """Write the parts to an object.

        Parameters
        ----------
        obj : bpy.types.Object
            The object that they were computed for.
        """
        write_parts(obj, self.decomposition, self.parameters, self.identities)


def edit_object(
    obj: bpy.types.Object,
    make_change: MakeChange,
    parameters: Parameters | None = None,
) -> Steps[Edited]:
    """Check and read an object with parts; return the steps that change them.

    Parameters
    ----------
    obj : bpy.types.Object
    make_change : callable
        Takes the shape, its memo and the present parts; returns the steps of a Change.
    parameters : Parameters, optional
        Decide the lines of sight; by default, as for the present parts.

    Returns
    -------
    Steps of Edited

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to.
    """
    check_writable(obj)
    parts, shape = present_parts(obj), read_shape(obj)
    parameters = parameters or parts.parameters

    notes = reading_notes(obj)

    def work() -> Steps[Edited]:
        yield from load_libraries()
        cache = session_cache()
        prepared = yield from within(cache.prepare(shape), 0.0, 0.1)
        memo = yield from within(cache.see(prepared, parameters), 0.1, 0.5)
        steps = make_change(shape, memo, parts)
        change = yield from within(steps, 0.5, 1.0)
        found, identities = _described(memo, parts, change, parameters)
        found = replace(found, notes=(*notes, *found.notes))
        return Edited(found, identities, parameters)

    return work()


def _described(
    memo: core.PartMemo,
    parts: PresentParts,
    change: core.Change,
    parameters: Parameters,
) -> tuple[Decomposition, tuple[Identity, ...]]:
    """Return changed parts as a decomposition, sorted by number, with identities."""
    labels, former = core.compacted(change.labels)
    before = with_sides(parts.identities, change.mirrored.values(), change.side)
    identities = identities_after(before, former.tolist(), change.mirrored)
    order = sorted(range(len(former)), key=lambda row: identities[row].number)
    labels, former = np.argsort(order)[labels], former[order]
    found = core.describe(
        memo.visibility, labels, parameters, parts.psi_by_k, parts.best_k
    )
    ranks = _ranks(found, parts, change, former.tolist())
    return replace(found, ranks=ranks), tuple(identities[row] for row in order)


def _ranks(
    found: Decomposition, parts: PresentParts, change: core.Change, former: list[int]
) -> NDArray[np.float64]:
    """Return the convexity rank of each part, from the best estimate there is, (K,).

    Only few samples of the whole shape lie on a small part. So unchanged parts keep
    their ranks, and parts that were split off have ranks from their own samples.
    """
    changed = parts.labels != change.labels
    touched = set(parts.labels[changed]) | set(change.labels[changed])
    ranks = found.ranks.copy()
    for row, label in enumerate(former):
        if label in change.ranks:
            ranks[row] = change.ranks[label]
        elif label not in touched and np.isclose(
            found.areas[row], parts.areas[label], rtol=_SAME_AREA
        ):
            ranks[row] = parts.ranks[label]
    return ranks
