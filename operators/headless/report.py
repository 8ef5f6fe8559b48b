"""The report of a run: what was asked for, and what came of each input."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from ...core.errors import DecompositionError
from ...core.parameters.parts import Parameters
from ..bridge.stored.notes import version
from .decompose_file import ObjectResult
from .write.models import replacing


@dataclass(frozen=True)
class InputResult:
    """What became of one input.

    Attributes
    ----------
    path : Path
        The file.
    objects : tuple of ObjectResult
        Empty if the file could not be read.
    errors : tuple of str
        Why it could not be read, or its results not be written.
    output, picture, hulls : Path or None
        The files that were written.
    seconds : float
        Time for all of it.
    """

    path: Path
    objects: tuple[ObjectResult, ...]
    errors: tuple[str, ...]
    output: Path | None
    picture: Path | None
    hulls: Path | None
    seconds: float

    @property
    def failed(self) -> bool:
        """Whether anything went wrong."""
        return bool(self.errors or any(obj.error for obj in self.objects))


def save_report(
    path: Path, results: Sequence[InputResult], parameters: Parameters
) -> None:
    """Write a report as JSON."""
    report = {
        "version": version(),
        "parameters": asdict(parameters),
        "inputs": [_input(result) for result in results],
    }
    try:
        with replacing(path) as unfinished:
            unfinished.write_text(
                json.dumps(report, indent=2, ensure_ascii=False) + "\n",
                encoding="utf-8",
            )
    except OSError as error:
        raise DecompositionError(
            f"{path} cannot be written ({error.strerror})."
        ) from error


def _input(result: InputResult) -> dict[str, Any]:
    """Return the entry of one input."""
    return {
        "input": str(result.path),
        "output": str(result.output) if result.output else None,
        "picture": str(result.picture) if result.picture else None,
        "hulls": str(result.hulls) if result.hulls else None,
        "errors": list(result.errors),
        "seconds": round(result.seconds, 3),
        "objects": [_object(obj) for obj in result.objects],
    }


def _object(result: ObjectResult) -> dict[str, Any]:
    """Return the entry of one object: its record, and what is known besides."""
    return {
        "name": result.name,
        "error": result.error,
        "notes": list(result.notes),
        "seconds": round(result.seconds, 3),
        **(result.record or {}),
    }
