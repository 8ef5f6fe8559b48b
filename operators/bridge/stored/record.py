"""The record of a result on its object: JSON for people, programs and the sidebar."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import bpy

from ....core.errors import DecompositionError
from ....core.parameters.parts import Parameters
from ....core.results.parts import Decomposition, Measurement
from ..mesh.fingerprint import MEASURED_ON, fingerprint_of
from .forms import RECORD, has_form
from .identity import Identity
from .names import RESULT
from .noted_parts import entry_of
from .notes import parameters_in, parse_json, read_note, version, write_note
from .restore import has_parts, read_restore, sharers

# The meshes of an object that parts can be found on: its own, or as it is seen.
# The choices, with their labels and tooltips.
ORIGINAL, EVALUATED = "ORIGINAL", "EVALUATED"
MESHES = (
    (ORIGINAL, "Original", "The mesh itself, as in Edit Mode"),
    (
        EVALUATED,
        "Evaluated",
        "The mesh as it is seen: with modifiers, shape keys and poses. Parts go to the"
        " faces that it comes from; if there are none, to a new object",
    ),
)
# Key of what is noted of hulls, and in that of each one.
HULLS = "hulls"

_MEASURED = "measured"
_SELECTION = "selection"
_ROUGH = "rough"


def has_record(obj: bpy.types.Object) -> bool:
    """Return whether there is anything of ours on an object or its mesh."""
    return RESULT in obj or has_parts(obj)


def parse_record(noted: object) -> dict[str, Any] | None:
    """Return the record that a custom property holds, None if it holds none of ours."""
    record = parse_json(noted)
    return record if has_form(record, RECORD) else None


def record_if_ours(obj: bpy.types.Object | None) -> dict[str, Any]:
    """Return what is noted on an object, empty if nothing of ours is."""
    return (parse_record(obj.get(RESULT)) if obj else None) or {}


def record_of(obj: bpy.types.Object) -> dict[str, Any]:
    """Return what is noted on an object, empty if nothing is."""
    return read_note(obj, RESULT, parse_record)


def write_record(obj: bpy.types.Object, record: dict[str, Any]) -> None:
    """Note a changed record on its object."""
    write_note(obj, RESULT, record)


def change_part(obj: bpy.types.Object, number: int, change: dict[str, Any]) -> None:
    """Change what is noted of a part on its object."""
    record = record_of(obj)
    entry = entry_of(record, number)
    if entry is not None:
        entry.update(change)
        write_record(obj, record)


def noted_parameters(obj: bpy.types.Object) -> Parameters | None:
    """Return the parameters that an object's parts were found with, None if unknown."""
    try:
        noted = record_of(obj).get("parameters")
        return None if noted is None else parameters_in(noted, Parameters)
    except DecompositionError:  # a property of the user's, or of a later version
        return None


def noted_mesh(obj: bpy.types.Object) -> str:
    """Return which mesh of an object its parts were found on."""
    return str(record_of(obj).get("mesh", ORIGINAL))


def note_mesh(obj: bpy.types.Object, mesh: str) -> None:
    """Note which mesh of an object its parts were found on."""
    for sharer in sharers(obj):
        write_record(sharer, {**record_of(sharer), "mesh": mesh})


def is_rough(obj: bpy.types.Object) -> bool:
    """Return whether an object's parts are noted as a first look at them."""
    noted = obj.get(RESULT)
    if not isinstance(noted, str) or _ROUGH not in noted:  # most are not: be quick
        return False
    return bool((parse_record(noted) or {}).get(_ROUGH))


def forget_rough(obj: bpy.types.Object) -> None:
    """Let an object keep parts that were a first look at them."""
    for sharer in sharers(obj):
        record = record_of(sharer)
        record.pop(_ROUGH, None)
        write_record(sharer, record)


def check_records(obj: bpy.types.Object) -> bool:
    """Return whether we have written to the mesh of an object.

    Raises
    ------
    DecompositionError
        If a custom property under one of our names is not ours.
    """
    record_of(obj)
    return obj.data is not None and read_restore(obj.data) is not None


def write_result(
    obj: bpy.types.Object,
    decomposition: Decomposition,
    parameters: Parameters,
    identities: Sequence[Identity],
    materials: Sequence[str],
    measured_on: Sequence[Sequence[float]],
) -> None:
    """Note a decomposition on its object; measurements and hulls stay noted."""
    result = {
        "version": version(),
        "parameters": asdict(parameters),
        "seed": parameters.seed,
        "k": decomposition.n_parts,
        "psi": _number(decomposition.psi),
        "psi_before": _number(decomposition.psi_before),
        "psi_by_k": {str(k): float(v) for k, v in decomposition.psi_by_k.items()},
        "best_k": decomposition.best_k,
        "pairs_cast": decomposition.pairs_cast,
        "pairs_inferred": decomposition.pairs_inferred,
        "parts": _entries(decomposition, identities, materials, measured_on),
        "notes": list(decomposition.notes),
    }
    if decomposition.rough:
        result[_ROUGH] = True
    beside = beside_parts(obj)
    for hull in beside.get(HULLS, {}).get(HULLS, ()):
        hull["part"] = None  # it is around a former part
    write_note(obj, RESULT, {**result, **beside})


def _entries(
    decomposition: Decomposition,
    identities: Sequence[Identity],
    materials: Sequence[str],
    measured_on: Sequence[Sequence[float]],
) -> list[dict[str, Any]]:
    """Return what is noted of each part."""
    return [
        {
            "name": identity.name,
            "number": identity.number,
            "color": list(identity.color),
            "material": material,
            "faces": faces,
            "area": area,
            "convexity_rank": _number(rank),
            MEASURED_ON: list(fingerprint),
        }
        for identity, material, faces, area, rank, fingerprint in zip(
            identities,
            materials,
            decomposition.face_counts.tolist(),
            decomposition.areas.tolist(),
            decomposition.ranks.tolist(),
            measured_on,
            strict=True,
        )
    ]


def _number(value: float) -> float | None:
    """Return a figure for JSON, None if it is not known."""
    return float(value) if math.isfinite(value) else None


def write_measurement(
    obj: bpy.types.Object,
    measurement: Measurement,
    parameters: dict[str, Any],
    faces: int | None = None,
) -> None:
    """Note a measurement of an object, or of some faces: `faces` is their number."""
    result = record_of(obj) or {"version": version()}
    noted = {
        "convexity_rank": float(measurement.rank),
        "standard_error": float(measurement.standard_error),
        "samples": int(measurement.n_samples),
        "pairs_cast": measurement.pairs_cast,
        "parameters": parameters,
        MEASURED_ON: fingerprint_of(obj),
        "notes": list(measurement.notes),
    }
    if faces is None:
        result[_MEASURED] = noted
    else:
        result[_SELECTION] = {"faces": faces, **noted}
    write_note(obj, RESULT, result)


def beside_parts(obj: bpy.types.Object) -> dict[str, Any]:
    """Return the measurements and hulls that are noted on an object."""
    result = record_of(obj)
    return {key: result[key] for key in (_MEASURED, _SELECTION, HULLS) if key in result}


def forget_parts(obj: bpy.types.Object) -> None:
    """Remove the record of a decomposition; measurements and hulls stay noted."""
    kept = beside_parts(obj)
    write_note(obj, RESULT, {"version": version(), **kept} if kept else {})


def forget_result(obj: bpy.types.Object) -> None:
    """Remove everything that was noted on an object."""
    write_note(obj, RESULT, {})
