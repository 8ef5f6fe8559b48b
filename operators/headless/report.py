"""Writes the report of a run (--report): parameters and results, as JSON.

`docs/report.schema.json` describes it. Whoever changes what a field means raises
`SCHEMA_VERSION`; a new field needs none.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ...core.results.psi import good_numbers
from ..bridge.mesh.fingerprint import MEASURED_ON
from ..bridge.stored.noted_parts import psi_by_k_of
from ..bridge.stored.notes import version
from .files.replacing import explaining, replacing
from .request.options import Request
from .request.outputs import STANDARD_STREAM
from .run.results import InputResult, ObjectResult
from .screen import write
from .stages import Stage, peak_memory

SCHEMA_VERSION = 1


def save_report(
    path: Path,
    results: Sequence[InputResult],
    request: Request,
    not_done: Sequence[Path],
) -> None:
    """Write the report of a run.

    Parameters
    ----------
    path : Path
        A file; ``-`` is standard output.
    results : sequence of InputResult
        Of the inputs that are finished.
    request : Request
    not_done : sequence of Path
        The inputs that are not, because the run was interrupted.

    Raises
    ------
    DecompositionError
        If the file cannot be written.
    """
    report = {
        "schema_version": SCHEMA_VERSION,
        "version": version(),
        "interrupted": bool(not_done),
        "parameters": asdict(request.parameters),
        "hull_parameters": asdict(request.hull_parameters),
        "body_parameters": asdict(request.body_parameters),
        "seconds": round(sum(result.seconds for result in results), 3),
        "peak_memory": peak_memory(),
        "inputs": [_input_entry(result) for result in results],
        "not_done": [str(path) for path in not_done],
    }
    if path == STANDARD_STREAM:
        # In ASCII: the stream may have any encoding.
        write(sys.stdout, json.dumps(report, indent=2, allow_nan=False) + "\n")
        return
    text = json.dumps(report, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    with explaining(path, "written"), replacing(path) as unfinished:
        # A path that is not Unicode becomes escapes, which JSON has too.
        unfinished.write_text(text, encoding="utf-8", errors="backslashreplace")


def _input_entry(result: InputResult) -> dict[str, Any]:
    """Return what the report says of one input."""
    written = vars(result.written).items()
    return {
        "input": str(result.path),
        **{name: str(path) if path else None for name, path in written},
        "errors": list(result.errors),
        "notes": list(result.notes),
        "seconds": round(result.seconds, 3),
        "stages": _stages_entry(result.stages),
        "objects": [_object_entry(obj) for obj in result.objects],
    }


def _stages_entry(stages: Mapping[str, Stage]) -> dict[str, Any]:
    """Return seconds and memory of each stage, None for those that were not needed."""
    return {
        name: {"seconds": round(stage.seconds, 3), "peak_memory": stage.peak_memory}
        if stage.seconds
        else None
        for name, stage in stages.items()
    }


def _object_entry(result: ObjectResult) -> dict[str, Any]:
    """Return what the report says of one object; its record is part of it."""
    record = _shown_record(result.record or {})
    hulls = {**record["hulls"], "hulls": list(result.hulls)} if result.hulls else None
    return {
        "name": result.name,
        "seconds": round(result.seconds, 3),
        "parts": None,
        **record,
        "error": result.error,
        "notes": list(dict.fromkeys((*result.notes, *record.get("notes", ())))),
        "hulls": hulls,
    }


def _shown_record(record: Mapping[str, Any]) -> dict[str, Any]:
    """Return a record with good numbers of parts, without what reruns need."""
    shown = {key: _without_fingerprint(value) for key, value in record.items()}
    if "parts" in shown:
        shown["good_k"] = good_numbers(psi_by_k_of(shown), shown["best_k"])
        shown["parts"] = list(map(_without_fingerprint, shown["parts"]))
    return shown


def _without_fingerprint(noted: Any) -> Any:
    """Return what is noted of some faces without what tells if they are the same."""
    if not isinstance(noted, dict):
        return noted
    return {key: value for key, value in noted.items() if key != MEASURED_ON}
