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
from ..stored.names import PART_LAYER
from ..stored.record import identities_of, noted_parameters, record_of


@dataclass(frozen=True, eq=False)
class PresentParts:
    """The parts of an object.

    Attributes
    ----------
    labels : (P,) int
        Part of each face, or point.
    identities : tuple of Identity
    locked : (K,) bool
        Which parts a new decomposition keeps.
    parameters : Parameters
        Of the decomposition that made the parts.
    areas : (K,) float
        As recorded, in square Blender units.
    ranks : (K,) float
        Convexity ranks, as recorded.
    psi_by_k : dict of int to float
        Psi of each number of parts that was tried.
    best_k : int
        The number of parts that the search chose.
    """

    labels: NDArray[np.int64]
    identities: tuple[Identity, ...]
    locked: NDArray[np.bool_]
    parameters: Parameters
    areas: NDArray[np.float64]
    ranks: NDArray[np.float64]
    psi_by_k: dict[int, float]
    best_k: int


def present_parts(obj: bpy.types.Object) -> PresentParts:
    """Return the parts of an object that passed `edit_refusal`."""
    flush_edits(obj)
    record = record_of(obj)
    entries = record["parts"]
    labels = layers_of(obj).faces(PART_LAYER)
    if labels is None:
        raise DecompositionError(
            f"{obj.name} has lost its attribute {PART_LAYER}; press Decompose again."
        )
    return PresentParts(
        # Blender gives any number to faces that the user adds.
        labels=np.clip(labels, 0, len(entries) - 1).astype(np.int64),
        identities=identities_of(record),
        locked=np.array([row.locked for row in obj.wcd_parts], dtype=bool),
        parameters=noted_parameters(obj) or Parameters(),
        areas=np.array([entry["area"] for entry in entries]),
        ranks=np.array([entry["convexity_rank"] for entry in entries]),
        psi_by_k={int(k): psi for k, psi in record["psi_by_k"].items()},
        best_k=record["best_k"],
    )
