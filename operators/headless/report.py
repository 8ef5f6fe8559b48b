"""Writes the report of a run (--report): parameters and results, as JSON."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ...core.parameters.parts import Parameters
from ..bridge.stored.notes import version
from .atomic import explaining, replacing
from .run.results import InputResult, ObjectResult


def save_report(
    path: Path, results: Sequence[InputResult], parameters: Parameters
) -> None:
    """Write the report of a run.

    Raises
    ------
    DecompositionError
        If the file cannot be written.
    """
    report = {
        "version": version(),
        "parameters": asdict(parameters),
        "inputs": [_input_entry(result) for result in results],
    }
    text = json.dumps(report, indent=2, ensure_ascii=False) + "\n"
    with explaining(path, "written"), replacing(path) as unfinished:
        unfinished.write_text(text, encoding="utf-8")


def _input_entry(result: InputResult) -> dict[str, Any]:
    """Return what the report says of one input."""
    return {
        "input": str(result.path),
        "output": str(result.output) if result.output else None,
        "picture": str(result.picture) if result.picture else None,
        "hulls": str(result.hulls) if result.hulls else None,
        "errors": list(result.errors),
        "seconds": round(result.seconds, 3),
        "objects": [_object_entry(obj) for obj in result.objects],
    }


def _object_entry(result: ObjectResult) -> dict[str, Any]:
    """Return what the report says of one object; its record is part of it."""
    return {
        "name": result.name,
        "error": result.error,
        "seconds": round(result.seconds, 3),
        **(result.record or {}),
        "notes": list(result.notes),
    }
