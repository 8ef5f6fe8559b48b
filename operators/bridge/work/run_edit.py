"""Edit the parts of an object: read it at once, compute in steps, then write."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import bpy
import numpy as np

from .... import core
from ....core.geometry.shape import Shape
from ....core.parameters.parts import Parameters
from ....core.results.parts import Decomposition
from ....core.steps.arrays import BoolArray, FloatArray, IntArray
from ....core.steps.progress import Steps, within
from ..cuts.new_faces import NewFaces
from ..mesh.layers import let_undo_see_all
from ..parts.identities import identities_after, with_sides
from ..parts.present_parts import PresentParts, present_parts
from ..parts.write import check_writable, write_parts
from ..read.evaluated import SeenMesh
from ..read.reading_notes import reading_notes
from ..read.shape import shape_in_steps
from ..stored.identity import Identity
from ..stored.record import EVALUATED, ORIGINAL, note_mesh, noted_mesh
from .libraries import load_libraries
from .session_cache import session_cache

MakeChange: TypeAlias = Callable[
    [Shape, "core.PartMemo", PresentParts], Steps["core.Change"]
]


@dataclass(frozen=True, eq=False)
class Edited:
    """The parts of an object after an edit or a new decomposition.

    Attributes
    ----------
    decomposition : Decomposition
    identities : tuple of Identity or None
        Who the parts are after an edit; None after a run, whose parts are matched with
        those of the object.
    parameters : Parameters
        Recorded on the object with the parts.
    by_hand : (P,) bool or None
        Faces that the user settled by hand.
    faces : NewFaces or None
        The faces that the object gets with the parts; None if it has them already.
    seen : SeenMesh or None
        The mesh as it is seen, if the parts were found on that.
    """

    decomposition: Decomposition
    identities: tuple[Identity, ...] | None
    parameters: Parameters
    by_hand: BoolArray | None = None
    faces: NewFaces | None = None
    seen: SeenMesh | None = None

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences to the user."""
        return self.decomposition.notes

    def write(self, obj: bpy.types.Object) -> None:
        """Write the parts to the object that they were computed for."""
        mesh = EVALUATED if self.seen else ORIGINAL
        if self.identities is not None:  # an edit finds no parts
            mesh = noted_mesh(obj)
        write_parts(
            obj,
            self.decomposition,
            self.parameters,
            self.identities,
            self.by_hand,
            self.faces,
        )
        note_mesh(obj, mesh)
        let_undo_see_all(obj)


def edit_object(obj: bpy.types.Object, make_change: MakeChange) -> Steps[Edited]:
    """Check and read an object with parts; return the steps that change them.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to.
    """
    check_writable(obj)
    parts, reading = present_parts(obj), shape_in_steps(obj)
    parameters = parts.parameters
    notes = reading_notes(obj)

    def work() -> Steps[Edited]:
        yield from load_libraries()
        shape, cache = (yield from reading), session_cache()
        prepared = yield from within(cache.prepare(shape), 0.0, 0.1)
        memo = yield from within(cache.see(prepared, parameters), 0.1, 0.5)
        steps = make_change(shape, memo, parts)
        change = yield from within(steps, 0.5, 1.0)
        found, identities = _described(memo, parts, change)
        found = replace(found, notes=(*notes, *found.notes, *change.notes))
        by_hand = parts.by_hand
        if change.by_hand is not None:
            by_hand = by_hand | change.by_hand
        return Edited(found, identities, parameters, by_hand)

    return work()


def _described(
    memo: core.PartMemo, parts: PresentParts, change: core.Change
) -> tuple[Decomposition, tuple[Identity, ...]]:
    """Return changed parts as a decomposition, and who they are."""
    labels, former = core.compacted(change.labels)
    before = with_sides(parts.identities, change.mirrored.values(), change.side)
    identities = identities_after(before, former.tolist(), change.mirrored)
    found = core.describe(
        memo.visibility, labels, parts.parameters, parts.psi_by_k, parts.best_k
    )
    found = with_known_ranks(found, parts.labels, parts.ranks)
    own = zip(former.tolist(), found.ranks.tolist(), strict=True)
    ranks = np.array([change.ranks.get(label, rank) for label, rank in own])
    return replace(found, ranks=ranks), tuple(identities)


def with_known_ranks(
    found: Decomposition, before: IntArray, known: FloatArray
) -> Decomposition:
    """Return parts with the ranks that they had, where no face came or went.

    Only few samples of the whole shape lie on a small part.

    Parameters
    ----------
    found : Decomposition
    before : (P,) int
        Part of each face before.
    known : (K,) float
        Ranks of these parts; nan for those that are not known.
    """
    ranks = found.ranks.copy()
    pairs = np.unique(np.stack([found.labels, before], axis=1), axis=0)
    alone = np.bincount(pairs[:, 0])[pairs[:, 0]] == 1
    alone &= np.bincount(pairs[:, 1])[pairs[:, 1]] == 1
    for part, former in pairs[alone]:
        if np.isfinite(known[former]):
            ranks[part] = known[former]
    return replace(found, ranks=ranks)
