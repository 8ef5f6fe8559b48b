"""What is noted of hulls: on their object, and on each of them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import bpy

from ....core.parameters.hulls import HullParameters
from ....core.results.hulls import HullDecomposition
from ..mesh.fingerprint import MEASURED_ON, fingerprint_of
from .names import HULL_TAG
from .notes import parameters_in, parse_json, version
from .record import HULLS, ORIGINAL, record_of, write_record


def figures_on(hull: bpy.types.Object) -> dict[str, Any]:
    """Return the figures that are noted on a hull, empty if none of ours are."""
    return parse_json(hull.get(HULL_TAG)) or {}


def noted_hulls(record: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return what a record says of each hull of its object."""
    noted: list[dict[str, Any]] = record.get(HULLS, {}).get(HULLS, [])
    return noted


def noted_hull_parameters(obj: bpy.types.Object) -> HullParameters:
    """Return the parameters that an object's hulls were built with."""
    noted = record_of(obj).get(HULLS, {}).get("parameters", {})
    return parameters_in(noted, HullParameters)


def noted_mesh_of_hulls(obj: bpy.types.Object) -> str:
    """Return which mesh of an object its hulls are around."""
    return str(record_of(obj)[HULLS].get("mesh", ORIGINAL))


def note_mesh_of_hulls(obj: bpy.types.Object, mesh: str) -> None:
    """Note which mesh of an object its hulls are around."""
    record = record_of(obj)
    record[HULLS]["mesh"] = mesh
    write_record(obj, record)


def write_hull_record(
    obj: bpy.types.Object,
    found: HullDecomposition,
    parameters: HullParameters,
    hulls: list[dict[str, Any]],
) -> None:
    """Note the hulls of an object; all else stays noted."""
    result = record_of(obj) or {"version": version()}
    ratio = found.volume_ratio
    result[HULLS] = {
        "parameters": asdict(parameters),
        "largest_error": float(found.errors.max()),
        "volume_ratio": ratio if math.isfinite(ratio) else None,
        HULLS: hulls,
        MEASURED_ON: fingerprint_of(obj),
        "notes": list(found.notes),
    }
    write_record(obj, result)


def forget_hulls(obj: bpy.types.Object) -> None:
    """Remove what is noted of an object's hulls; all else stays noted."""
    record = {key: kept for key, kept in record_of(obj).items() if key != HULLS}
    write_record(obj, record if record.keys() - {"version"} else {})
