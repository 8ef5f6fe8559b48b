"""Decompose an object again; what the user locked, or settled by hand, stays.

The rule: a locked part stays as it is, and so does a part all of whose faces were
settled by hand, by a merge, a split or Assign Faces. They are left out of the run. If
only some faces of a part were settled, the run covers them, and they are then given
back to the part. Smooth Seams and Mirror settle nothing; locks do.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
import numpy as np

from .... import core
from ....core.errors import DecompositionError
from ....core.parameters.parts import Parameters
from ....core.results.parts import Decomposition
from ....core.steps.arrays import BoolArray
from ....core.steps.progress import Steps, within
from ..mesh.by_label import areas_of, read_ahead
from ..mesh.layers import layers_of
from ..parts.present_parts import PresentParts, present_parts
from ..parts.read import part_labels
from ..parts.write import check_writable
from ..read.evaluated import SeenMesh
from ..read.target import ShapeThen, Target
from ..refusals import edit_refusal
from ..stored.names import HAND_LAYER
from ..stored.noted_parts import psi_by_k_of
from ..stored.record import record_of
from .computing import decompose_object, read_seen
from .cutting import decompose_whole_faces, gets_new_faces
from .libraries import load_libraries
from .run_edit import Edited, with_known_ranks
from .session_cache import session_cache

_MOVED = (
    "The shape or scale was changed meanwhile: these are the parts that it had before,"
    " and Refresh measures them."
)
_NOT_CUT = (
    "No more faces were cut, because some parts are locked or settled by hand; unlock"
    " them, or clear Keep Edits."
)


class AllPartsStay(DecompositionError):
    """The user settled all parts of an object: there is nothing to decompose."""


def decompose_unlocked(
    obj: bpy.types.Object,
    parameters: Parameters,
    keep_edits: bool = True,
    seen: SeenMesh | None = None,
    rough: bool = False,
) -> Steps[Edited]:
    """Return the steps that decompose an object, except for what the user settled.

    Parameters
    ----------
    obj : bpy.types.Object
    parameters : Parameters
        Numbers of parts include the parts that stay.
    keep_edits : bool
        Whether what the user settled by hand stays; locked parts always do.
    seen : SeenMesh, optional
        The mesh as it is seen, to be used in place of the object's own.
    rough : bool, optional
        Whether a first look at the parts is enough; only if the run covers all faces.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to, all parts stay, or the
        number of parts leaves none for the other faces.
    """
    if _may_hold(obj, keep_edits):
        check_writable(obj)
        parts = present_parts(obj)
        by_hand = parts.by_hand & keep_edits
        held = _held(parts, by_hand)
        if held.any() or by_hand.any():
            parts = replace(parts, by_hand=by_hand)
            return _decompose_rest(obj, parameters, parts, held, seen)
    if gets_new_faces(obj, parameters, seen):
        return decompose_whole_faces(obj, parameters)
    steps = decompose_object(obj, parameters, seen, rough)
    steps = _with_known_numbers(steps, record_of(obj))
    return _ready_to_write(obj, steps, parameters, seen)


def _ready_to_write(
    obj: bpy.types.Object,
    steps: Steps[Decomposition],
    parameters: Parameters,
    seen: SeenMesh | None,
    by_hand: BoolArray | None = None,
) -> Steps[Edited]:
    """Find parts, then read what writing them asks of a mesh: this takes long, too."""
    target, then = Target.of(obj), ShapeThen.of(obj)

    def work() -> Steps[Edited]:
        found = yield from within(steps, 0.0, 0.99)
        if seen is not None:
            found = seen.on_own_faces(found)
        if not then.is_of(target.find()):
            unknown = np.full(found.n_parts, np.nan)
            found = replace(found, ranks=unknown, notes=(*found.notes, _MOVED))
        reading = read_ahead(target.find, found.labels, found.n_parts)
        yield from within(reading, 0.99, 1.0)
        return Edited(found, None, parameters, by_hand, seen=seen)

    return work()


def _with_known_numbers(
    steps: Steps[Decomposition], record: dict[str, Any]
) -> Steps[Decomposition]:
    """Give a first look the psi of numbers of parts that it did not try."""
    found = yield from steps
    if not found.rough:
        return found
    known = {**psi_by_k_of(record), **found.psi_by_k}
    best_k = found.best_k or record.get("best_k", found.n_parts)
    return replace(found, psi_by_k=known, best_k=best_k)


def _may_hold(obj: bpy.types.Object, keep_edits: bool) -> bool:
    """Return whether something may be settled: to measure all parts takes longer."""
    if edit_refusal(obj) is not None:
        return False
    locked = any(row.locked for row in obj.wcd_parts)
    by_hand = keep_edits and layers_of(obj).faces(HAND_LAYER) is not None
    return (locked or by_hand) and part_labels(obj) is not None


def _held(parts: PresentParts, by_hand: BoolArray) -> BoolArray:
    """Return which parts a run leaves out: the locked, and those settled as a whole."""
    n_parts = len(parts.identities)
    free = np.bincount(parts.labels, ~by_hand, n_parts)
    return parts.locked | (free == 0)


def _decompose_rest(
    obj: bpy.types.Object,
    parameters: Parameters,
    parts: PresentParts,
    held: BoolArray,
    seen: SeenMesh | None,
) -> Steps[Edited]:
    """Return the steps that decompose the other faces, from their own samples."""
    rest = _parameters_of_rest(parameters, parts, held)
    before, by_hand = parts.labels, parts.by_hand
    notes, reading = read_seen(obj, seen)
    if seen is None:
        areas = areas_of(obj, len(before))
    else:
        areas = seen.areas
        before, by_hand = before[seen.origins], by_hand[seen.origins]
    if parameters.seams == "CUT":
        notes = (*notes, _NOT_CUT)
    members = ~held[before]

    def work() -> Steps[Decomposition]:
        yield from load_libraries()
        shape, cache = (yield from reading), session_cache()
        some = members if held.any() else None
        running = core.decompose_in_steps(shape, rest, cache, some)
        run = yield from within(running, 0.0, 0.6)
        after = before.copy()
        after[members] = len(held) + run.labels
        labels = core.given_back(before, after, areas, by_hand | ~members)
        prepared = yield from within(cache.prepare(shape), 0.6, 0.7)
        memo = yield from within(cache.see(prepared, parameters), 0.7, 0.9)
        searched = parts if held.any() else run
        found = core.describe(
            memo.visibility, labels, parameters, searched.psi_by_k, searched.best_k
        )
        ranks = np.concatenate([parts.ranks, run.ranks])
        found = with_known_ranks(found, after, ranks)
        pairs = yield from within(core.mirror_pairs(memo, labels), 0.9, 1.0)
        most = int(held.sum()) + max(run.psi_by_k)
        on_count = core.notes_on_count(parameters, most)
        return replace(found, pairs=pairs, notes=(*notes, *found.notes, *on_count))

    return _ready_to_write(obj, work(), parameters, seen, parts.by_hand)


def _parameters_of_rest(
    parameters: Parameters, parts: PresentParts, held: BoolArray
) -> Parameters:
    """Return parameters for the other faces, without the parts that stay in numbers."""
    n_held, n_parts = int(held.sum()), parameters.parts
    if not n_held:
        return parameters
    kept = "locked" if (held == parts.locked).all() else "locked or edited by hand"
    way_out = "unlock some" if kept == "locked" else "unlock some, or clear Keep Edits"
    if held.all():
        raise AllPartsStay(
            f"All parts are {kept}, so nothing is left to decompose; {way_out}."
        )
    if n_parts and n_parts <= n_held:
        count = "1 part is" if n_held == 1 else f"{n_held} parts are"
        raise DecompositionError(
            f"Parts is {n_parts}, but {count} {kept}, which counts too; raise"
            f" it to {n_held + 1} at least, set it to 0, or {way_out}."
        )
    fewest = max(2, parameters.min_parts - n_held)
    return replace(
        parameters,
        parts=n_parts - n_held if n_parts else 0,
        min_parts=fewest,
        max_parts=max(fewest, parameters.max_parts - n_held),
    )
