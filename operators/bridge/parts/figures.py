"""The figures of the parts that an object has now: they follow the mesh.

Faces and areas are counted. Convexity ranks and psi are noted with the faces that they
were measured on, and are known only while a part still has these.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ....core.steps.arrays import FloatArray
from ..mesh.by_label import sums_by_label
from ..mesh.fingerprint import fits
from ..stored.noted_parts import entry_of
from ..stored.record import record_of
from .read import FoundParts, find_parts_on

JOINED = (
    "Some parts are not listed, as after a join or an applied Array; press Refresh to"
    " list them."
)


@dataclass(frozen=True, eq=False)
class PartFigures(FoundParts):
    """What is known of the parts of an object, beside who they are.

    Attributes
    ----------
    measured_on : (K, 5) float
        Of each part: number of faces, area and center. Points have an area of 1 each.
    ranks : (K,) float
        Convexity ranks; nan where a part has changed since it was measured.
    record : dict
        What is noted of the parts, whether or not it fits them.
    problem : str or None
        Why figures are out of date, and what to do.
    """

    measured_on: FloatArray
    ranks: FloatArray
    record: dict[str, Any]
    problem: str | None


def figures_of(obj: bpy.types.Object) -> PartFigures | None:
    """Return the figures of an object's parts, None if it has none."""
    found = find_parts_on(obj)
    if found is None:
        return None
    record = record_of(obj)
    measured_on = sums_by_label(obj, found.labels, len(found.identities))
    ranks = np.full(len(measured_on), np.nan)
    for row, (identity, origin) in enumerate(
        zip(found.identities, found.origins, strict=True)
    ):
        entry = entry_of(record, identity.number) if origin.turn == 0 else None
        if entry is None or entry["convexity_rank"] is None:
            continue
        if fits(entry, measured_on[row]):
            ranks[row] = entry["convexity_rank"]
    problem = _problem(record, found, measured_on)
    return PartFigures(
        **vars(found),
        measured_on=measured_on,
        ranks=ranks,
        record=record,
        problem=problem,
    )


def _problem(
    record: dict[str, Any], found: FoundParts, measured_on: FloatArray
) -> str | None:
    """Return why the record is not all that there is to know, None if it is."""
    if not found.in_step:
        return JOINED
    entries = record.get("parts", ())
    now = {
        each.number: row
        for each, row in zip(found.identities, measured_on, strict=True)
    }
    same = {entry["number"] for entry in entries} == now.keys()
    fit = same and all(fits(entry, now[entry["number"]]) for entry in entries)
    if fit and record["psi"] is not None:
        return None
    return "The mesh has changed; press Refresh to measure the parts again."
