"""The parts that an object has now, as edits of them need them."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from ....core.errors import DecompositionError
from ....core.parameters.parts import Parameters
from ....core.steps.arrays import BoolArray
from ..mesh.layers import flush_edits, layers_of
from ..stored.names import HAND_LAYER
from ..stored.noted_parts import n_faces_of, psi_by_k_of
from ..stored.record import noted_parameters
from .figures import PartFigures, figures_of
from .read import loss_of


@dataclass(frozen=True, eq=False)
class PresentParts(PartFigures):
    """The parts of an object, and what of them a new run keeps.

    Attributes
    ----------
    locked : (K,) bool
        Which parts a new decomposition keeps.
    by_hand : (P,) bool
        Which faces the user settled by hand.
    parameters : Parameters
        Of the decomposition that made the parts.
    psi_by_k : dict of int to float
        Psi of each number of parts that was tried; empty once faces came or went.
    best_k : int
        The number of parts that the search chose.
    """

    locked: BoolArray
    by_hand: BoolArray
    parameters: Parameters
    psi_by_k: dict[int, float]
    best_k: int


def present_parts(obj: bpy.types.Object) -> PresentParts:
    """Return the parts of an object that passed `edit_refusal`."""
    flush_edits(obj)
    figures = figures_of(obj)
    if figures is None:
        raise DecompositionError(loss_of(obj))
    locks = {row.number for row in obj.wcd_parts if row.locked}
    # Gains by number of parts are those of the mesh that was decomposed.
    same_mesh = n_faces_of(figures.record) == len(figures.labels)
    return PresentParts(
        **vars(figures),
        locked=np.array([each.number in locks for each in figures.identities]),
        by_hand=faces_by_hand(obj, len(figures.labels)),
        parameters=noted_parameters(obj) or Parameters(),
        psi_by_k=psi_by_k_of(figures.record) if same_mesh else {},
        best_k=figures.record.get("best_k", len(figures.identities)),
    )


def faces_by_hand(obj: bpy.types.Object, n_faces: int) -> BoolArray:
    """Return which faces of an object the user settled by hand, (P,)."""
    flags = layers_of(obj).faces(HAND_LAYER)
    if flags is None or len(flags) != n_faces:
        return np.zeros(n_faces, dtype=bool)
    return flags > 0
