"""What a run did: the result of each object and of each input."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..request.outputs import Targets
from ..stages import Stage


@dataclass(frozen=True)
class ObjectResult:
    """What happened to one object.

    Attributes
    ----------
    name : str
        Name of the object in the file.
    record : dict or None
        The record stored on the object, None if nothing was computed of it.
    summary : str
        Its figures in one line, empty if it was not decomposed.
    notes : tuple of str
        Warnings; none of them stopped the work.
    error : str or None
        Why the object could not be decomposed, or got no hulls.
    seconds : float
        Time for the decomposition, and for its hulls.
    hulls : tuple of dict
        What the report says of each hull.
    """

    name: str
    record: dict[str, Any] | None = None
    summary: str = ""
    notes: tuple[str, ...] = ()
    error: str | None = None
    seconds: float = 0.0
    hulls: tuple[dict[str, Any], ...] = ()


@dataclass(frozen=True)
class InputResult:
    """What happened to one input.

    Attributes
    ----------
    path : Path
        The input.
    objects : tuple of ObjectResult
        Empty if the input could not be read.
    notes : tuple of str
        Warnings about the file as a whole.
    errors : tuple of str
        Why the input could not be read, or a result could not be written.
    written : Targets
        The files that were written.
    seconds : float
        Time for everything.
    stages : dict of str to Stage
        Time and memory by stage.
    """

    path: Path
    objects: tuple[ObjectResult, ...]
    notes: tuple[str, ...]
    errors: tuple[str, ...]
    written: Targets
    seconds: float
    stages: dict[str, Stage]

    @property
    def failed(self) -> bool:
        """Whether anything went wrong."""
        return bool(self.errors or any(obj.error for obj in self.objects))
