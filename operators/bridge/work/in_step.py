"""Bring what is noted of parts in step with the faces, without measuring them."""

from __future__ import annotations

from contextlib import suppress

import bpy
import numpy as np

from ....core.errors import DecompositionError
from ....core.parameters.parts import Parameters
from ....core.results.parts import Decomposition
from ..parts.figures import figures_of
from ..parts.present_parts import faces_by_hand
from ..parts.write import write_parts
from ..stored.names import RESULT
from ..stored.record import noted_parameters, record_of, write_record
from ..stored.restore import sharers
from ..stored.versions import PAST, past_with


def bring_in_step(obj: bpy.types.Object) -> None:
    """Write an object's parts again if some of them share a number, after a join.

    What was not measured together stays unknown until it is.
    """
    figures = figures_of(obj)
    if figures is None or figures.found.in_step:
        return
    counts, areas = (
        figures.measured_on[:, 0].astype(np.int64),
        figures.measured_on[:, 1],
    )
    parameters = noted_parameters(obj) or Parameters()
    unknown = float("nan")
    decomposition = Decomposition(
        labels=figures.found.labels,
        areas=areas,
        face_counts=counts,
        ranks=figures.ranks,
        psi_before=unknown,
        psi=unknown,
        psi_by_k={},
        best_k=len(counts),
        notes=(),
    )
    by_hand = faces_by_hand(obj, len(figures.found.labels))
    write_parts(obj, decomposition, parameters, figures.identities, by_hand)


def bring_back_record(obj: bpy.types.Object) -> None:
    """Let the record be the version that fits the faces, after undo in Edit Mode."""
    noted = record_of(obj)
    figures = figures_of(obj) if PAST in noted else None
    if figures is None or figures.problem or noted["parts"] == figures.record["parts"]:
        return
    others = [
        version
        for version in past_with(noted)
        if version["parts"] != figures.record["parts"]
    ]
    for sharer in sharers(obj):
        write_record(sharer, {**figures.record, PAST: others})


def let_undo_see_all(obj: bpy.types.Object) -> None:
    """Let the undo step of an operator that changes an object in Edit Mode hold it all.

    Such steps hold faces and their layers, and the whole file only if a data-block came
    or went. Groups, slots and notes come back with the file alone.
    """
    if obj.mode == "EDIT":
        bpy.data.materials.remove(bpy.data.materials.new("undo"))


@bpy.app.handlers.persistent
def _after_undo(*_: object) -> None:
    """Look after the objects in Edit Mode. Blender passes arguments to handlers."""
    for obj in bpy.context.view_layer.objects:
        if obj.type == "MESH" and obj.mode == "EDIT" and RESULT in obj:
            with suppress(DecompositionError):  # a property of the user's
                bring_back_record(obj)


def register() -> None:
    """Look after undo and redo: in Edit Mode they bring back no properties."""
    bpy.app.handlers.undo_post.append(_after_undo)
    bpy.app.handlers.redo_post.append(_after_undo)


def unregister() -> None:
    """Undo `register`."""
    bpy.app.handlers.redo_post.remove(_after_undo)
    bpy.app.handlers.undo_post.remove(_after_undo)
