"""Edits of an object's parts: read at once, computed step by step, then written."""

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
from .computing import load_libraries
from .session_cache import session_cache

MakeChange: TypeAlias = Callable[
    [Shape, "core.PartMemo", PresentParts], Steps["core.Change"]
]

# Areas that differ by less, in shares of themselves, are those of the same faces.
_SAME_AREA = 1e-4


@dataclass(frozen=True, eq=False)
class Edited:
    """Parts after an edit.

    Attributes
    ----------
    decomposition : Decomposition
    identities : tuple of Identity or None
        Of the parts that are kept and of the others; None if all are new.
    parameters : Parameters
        To be recorded with it.
    """

    decomposition: Decomposition
    identities: tuple[Identity, ...] | None
    parameters: Parameters

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences to the user about what is worth knowing."""
        return self.decomposition.notes

    def write(self, obj: bpy.types.Object) -> None:
        """Show the parts on their object."""
        write_parts(obj, self.decomposition, self.parameters, self.identities)


def edit_object(
    obj: bpy.types.Object,
    make_change: MakeChange,
    parameters: Parameters | None = None,
) -> Steps[Edited]:
    """Check and read an object with parts; return the work of changing them.

    Parameters
    ----------
    obj : bpy.types.Object
    make_change : callable
        Returns the change from the shape, what is known of it, and the parts.
    parameters : Parameters, optional
        Of the visibility; those that the parts were found with if left out.

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
    """Return the figures of changed parts, in the order of their numbers."""
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
    """Return the rank of each part, as well as it is known.

    The samples of the whole shape that lie on a small part are few: ranks of parts that
    are as they were stay, and those split off have one from samples of their own.
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
