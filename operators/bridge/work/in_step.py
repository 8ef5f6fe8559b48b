"""Bring what is noted of parts in step with the faces, without measuring them."""

from __future__ import annotations

import bpy

from ....core.parameters.parts import Parameters
from ....core.results.parts import Decomposition
from ..mesh.layers import flush_edits
from ..parts.figures import figures_of
from ..parts.present_parts import faces_by_hand
from ..stored.noted_parts import identities_of
from ..stored.record import noted_parameters, record_of
from .run_edit import Edited


def bring_in_step(obj: bpy.types.Object) -> None:
    """Write an object's parts again after a join, if the record does not know all.

    Some of them share a number then, or have one that is new. What was not measured
    together stays unknown until it is.
    """
    flush_edits(obj)
    figures = figures_of(obj)
    if figures is None:
        return
    noted = {each.number for each in identities_of(record_of(obj))}
    there = {each.number for each in figures.identities}
    if figures.in_step and there <= noted:
        return
    unknown = float("nan")
    decomposition = Decomposition(
        labels=figures.labels,
        areas=figures.measured_on[:, 1],
        ranks=figures.ranks,
        psi_before=unknown,
        psi=unknown,
        psi_by_k={},
        best_k=len(figures.ranks),
        notes=(),
    )
    parameters = noted_parameters(obj) or Parameters()
    by_hand = faces_by_hand(obj, len(figures.labels))
    Edited(decomposition, figures.identities, parameters, by_hand).write(obj)
