"""The parts that an object has now, as edits of them need them."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import NDArray

from ....core.errors import DecompositionError
from ....core.parameters.parts import Parameters
from ..mesh.layers import flush_edits, layers_of
from ..stored.identity import Identity
from ..stored.names import HAND_LAYER
from ..stored.noted_parts import n_faces_of, psi_by_k_of
from ..stored.record import noted_parameters
from .figures import figures_of
from .read import loss_of


@dataclass(frozen=True, eq=False)
class PresentParts:
    """The parts of an object.

    Attributes
    ----------
    labels : (P,) int
        Place of the part of each face, or point, in `identities`.
    identities : tuple of Identity
        By number.
    locked : (K,) bool
        Which parts a new decomposition keeps.
    by_hand : (P,) bool
        Which faces the user settled by hand.
    parameters : Parameters
        Of the decomposition that made the parts.
    ranks : (K,) float
        Convexity ranks; nan where a part has changed since it was measured.
    psi_by_k : dict of int to float
        Psi of each number of parts that was tried; empty once faces came or went.
    best_k : int
        The number of parts that the search chose.
    """

    labels: NDArray[np.int64]
    identities: tuple[Identity, ...]
    locked: NDArray[np.bool_]
    by_hand: NDArray[np.bool_]
    parameters: Parameters
    ranks: NDArray[np.float64]
    psi_by_k: dict[int, float]
    best_k: int


def present_parts(obj: bpy.types.Object) -> PresentParts:
    """Return the parts of an object that passed `edit_refusal`."""
    flush_edits(obj)
    figures = figures_of(obj)
    if figures is None:
        raise DecompositionError(loss_of(obj))
    locks = {row.number for row in obj.wcd_parts if row.locked}
    record = figures.record
    # Gains by number of parts are those of the mesh that was decomposed.
    same_mesh = n_faces_of(record) == len(figures.found.labels)
    return PresentParts(
        labels=figures.found.labels,
        identities=figures.identities,
        locked=np.array([each.number in locks for each in figures.identities]),
        by_hand=faces_by_hand(obj, len(figures.found.labels)),
        parameters=noted_parameters(obj) or Parameters(),
        ranks=figures.ranks,
        psi_by_k=psi_by_k_of(record) if same_mesh else {},
        best_k=record.get("best_k", len(figures.identities)),
    )


def faces_by_hand(obj: bpy.types.Object, n_faces: int) -> NDArray[np.bool_]:
    """Return which faces of an object the user settled by hand, (P,)."""
    flags = layers_of(obj).faces(HAND_LAYER)
    if flags is None or len(flags) != n_faces:
        return np.zeros(n_faces, dtype=bool)
    return flags > 0
