"""What we note in the user's file, as JSON in custom properties.

On the object, `wcd`: the result, for people and programs. On the mesh, `wcd_restore`:
what it takes to bring the mesh back, because groups, slots and attributes are the
mesh's, whichever of its objects was active.
"""

from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from ...core.errors import DecompositionError
from ...core.hull_parameters import HullParameters
from ...core.parameters import Parameters
from ...core.record import parse_json, parse_record
from .identity import Identity

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ...core.decomposition import Decomposition, Measurement
    from ...core.hull_decomposition import HullDecomposition

_RESULT = "wcd"
_RESTORE = "wcd_restore"
_MEASURED = "measured"
_SELECTION = "selection"
_HULLS = "hulls"
_MANIFEST = Path(__file__).parents[2] / "blender_manifest.toml"


@dataclass(frozen=True)
class Restore:
    """What it takes to bring a mesh back.

    Attributes
    ----------
    groups : list of str
        Names of the vertex groups that we made, in the order of the parts.
    active_group : str
        Name of the active group before; empty if there was none.
    slots : list of str
        Names of the materials in the slots before; empty for an empty slot.
    active_slot : int
        Index of the active slot of the object before.
    material_index : int or None
        The one material index that all faces had, None if they differed.
    had_material_index : bool
        Whether the mesh kept material indices at all.
    """

    groups: list[str]
    active_group: str
    slots: list[str]
    active_slot: int
    material_index: int | None
    had_material_index: bool


def read_restore(mesh: bpy.types.Mesh) -> Restore | None:
    """Return what was noted on a mesh, None if we have not written to it."""
    noted = _read(mesh, _RESTORE)
    if not noted:
        return None
    if noted.keys() != {field.name for field in fields(Restore)}:
        raise _not_ours(mesh, _RESTORE)
    return Restore(**noted)


def write_restore(mesh: bpy.types.Mesh, restore: Restore | None) -> None:
    """Note on a mesh how to bring it back; None removes the note."""
    _write(mesh, _RESTORE, asdict(restore) if restore else {})


def has_record(obj: bpy.types.Object) -> bool:
    """Return whether there is anything of ours on an object or its mesh."""
    return _RESULT in obj or _RESTORE in obj.data


def record_of(obj: bpy.types.Object) -> dict[str, Any]:
    """Return what is noted on an object, empty if nothing is."""
    return _read(obj, _RESULT)


def identities_of(record: dict[str, Any]) -> tuple[Identity, ...]:
    """Return the identities of a record's parts, in their order."""
    return tuple(
        Identity(part.get("number", place), part["name"])
        for place, part in enumerate(record.get("parts", ()))
    )


def write_record(obj: bpy.types.Object, record: dict[str, Any]) -> None:
    """Note a changed record on its object."""
    _write(obj, _RESULT, record)


def has_parts(obj: bpy.types.Object) -> bool:
    """Return whether the mesh of an object has parts of ours."""
    return _RESTORE in obj.data


def noted_parameters(obj: bpy.types.Object) -> Parameters | None:
    """Return what the parts of an object were found with, None if it is not noted."""
    try:
        noted = _read(obj, _RESULT).get("parameters")
    except DecompositionError:  # a property of the user's
        return None
    if noted is None:
        return None
    known = {each.name for each in fields(Parameters)}  # other versions have others
    return Parameters(**{name: noted[name] for name in known & noted.keys()})


def check_records(obj: bpy.types.Object) -> None:
    """Raise if a custom property under one of our names is not ours."""
    read_restore(obj.data)
    _read(obj, _RESULT)


def write_result(
    obj: bpy.types.Object,
    decomposition: Decomposition,
    parameters: Parameters,
    identities: Sequence[Identity],
    materials: list[str],
) -> None:
    """Note a decomposition on its object, keeping all else."""
    parts = zip(
        identities,
        materials,
        decomposition.face_counts.tolist(),
        decomposition.areas.tolist(),
        decomposition.ranks.tolist(),
        strict=True,
    )
    result = {
        "version": version(),
        "parameters": asdict(parameters),
        "seed": parameters.seed,
        "k": decomposition.n_parts,
        "psi": float(decomposition.psi),
        "psi_before": float(decomposition.psi_before),
        "psi_by_k": {str(k): float(v) for k, v in decomposition.psi_by_k.items()},
        "best_k": decomposition.best_k,
        "parts": [
            {
                "name": identity.name,
                "number": identity.number,
                "material": material,
                "faces": faces,
                "area": area,
                "convexity_rank": rank,
            }
            for identity, material, faces, area, rank in parts
        ],
        "notes": list(decomposition.notes),
    }
    beside = _beside_parts(obj)
    for hull in beside.get(_HULLS, {}).get("hulls", ()):
        hull["part"] = None  # it is around one of the parts that were before
    _write(obj, _RESULT, {**result, **beside})


def write_measurement(
    obj: bpy.types.Object,
    measurement: Measurement,
    parameters: dict[str, Any],
    faces: int | None = None,
) -> None:
    """Note a measurement of an object, or of so many of its faces, keeping all else."""
    result = _read(obj, _RESULT) or {"version": version()}
    noted = {
        "convexity_rank": float(measurement.rank),
        "standard_error": float(measurement.standard_error),
        "samples": int(measurement.n_samples),
        "parameters": parameters,
        "notes": list(measurement.notes),
    }
    if faces is None:
        result[_MEASURED] = noted
    else:
        result[_SELECTION] = {"faces": faces, **noted}
    _write(obj, _RESULT, result)


def write_hull_record(
    obj: bpy.types.Object,
    found: HullDecomposition,
    parameters: HullParameters,
    hulls: list[dict[str, Any]],
) -> None:
    """Note the hulls of an object, keeping what else is noted."""
    result = _read(obj, _RESULT) or {"version": version()}
    ratio = found.volume_ratio
    result[_HULLS] = {
        "parameters": asdict(parameters),
        "largest_error": float(found.errors.max()),
        "volume_ratio": ratio if math.isfinite(ratio) else None,
        "hulls": hulls,
        "notes": list(found.notes),
    }
    _write(obj, _RESULT, result)


def _beside_parts(obj: bpy.types.Object) -> dict[str, Any]:
    """Return what is noted on an object besides its decomposition."""
    result = _read(obj, _RESULT)
    return {
        key: result[key] for key in (_MEASURED, _SELECTION, _HULLS) if key in result
    }


def forget_parts(obj: bpy.types.Object) -> None:
    """Remove what was noted of a decomposition, keeping all else."""
    kept = _beside_parts(obj)
    _write(obj, _RESULT, {"version": version(), **kept} if kept else {})


def forget_result(obj: bpy.types.Object) -> None:
    """Remove everything that was noted on an object."""
    _write(obj, _RESULT, {})


def version() -> str:
    """Return the version of the extension."""
    manifest = tomllib.loads(_MANIFEST.read_text(encoding="utf-8"))
    return str(manifest["version"])


def _read(owner: bpy.types.ID, key: str) -> dict[str, Any]:
    """Return one of our records, empty if there is none."""
    if key not in owner:
        return {}
    parse = parse_record if key == _RESULT else parse_json
    noted = parse(owner[key])
    if noted is None:
        raise _not_ours(owner, key)
    return noted


def _not_ours(owner: bpy.types.ID, key: str) -> DecompositionError:
    return DecompositionError(
        f"{owner.name} has a custom property {key} that this add-on did not write;"
        " rename or delete it."
    )


def _write(owner: bpy.types.ID, key: str, noted: dict[str, Any]) -> None:
    """Write one of our records; an empty one removes it."""
    if noted:
        owner[key] = json.dumps(noted)
    elif key in owner:
        del owner[key]
