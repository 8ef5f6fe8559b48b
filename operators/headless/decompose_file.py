"""Decomposes the mesh objects of a file, one after the other."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import bpy

from ...core.errors import DecompositionError
from ...core.parameters.parts import Parameters
from ...core.steps.progress import Progress, mapped, run
from ..bridge.mesh.points import is_cloud
from ..bridge.parts.write import write_parts
from ..bridge.stored.record import record_of
from ..bridge.work.computing import decompose_object, summary
from .screen import Screen


@dataclass(frozen=True)
class ObjectResult:
    """What became of one object.

    Attributes
    ----------
    name : str
        Name of the object in the file.
    record : dict or None
        What is noted on the object as well, None if it was not decomposed.
    summary : str
        Its figures in a line, empty if it was not decomposed.
    notes : tuple of str
        Findings that stopped nothing.
    error : str or None
        Why the object could not be decomposed.
    seconds : float
        Time that the decomposition took.
    """

    name: str
    record: dict[str, Any] | None = None
    summary: str = ""
    notes: tuple[str, ...] = ()
    error: str | None = None
    seconds: float = 0.0


def decompose_objects(
    file_name: str,
    objects: Sequence[bpy.types.Object],
    parameters: Parameters,
    screen: Screen,
) -> tuple[ObjectResult, ...]:
    """Decompose each object, and say on the screen what came of it."""
    done: dict[bpy.types.ID, str] = {}
    results = []
    for obj in objects:
        if not (is_cloud(obj) or obj.data.polygons):
            note = "It has no faces and was left as it is."
            result = ObjectResult(obj.name_full, notes=(note,))
        elif obj.data in done:
            note = f"It shares the mesh of {done[obj.data]}, and so its parts."
            result = ObjectResult(obj.name_full, notes=(note,))
        else:
            done[obj.data] = obj.name_full
            result = _decompose(file_name, obj, parameters, screen)
        _show(file_name, result, screen)
        results.append(result)
    return tuple(results)


def _decompose(
    file_name: str,
    obj: bpy.types.Object,
    parameters: Parameters,
    screen: Screen,
) -> ObjectResult:
    """Decompose one object and write the parts to it."""
    title = f"{file_name}, {obj.name_full}"

    def show(progress: Progress) -> Progress:
        screen.progress(title, progress)
        return progress

    started = time.perf_counter()
    try:
        steps = decompose_object(obj, parameters)
        decomposition = run(mapped(steps, show))
        write_parts(obj, decomposition, parameters)
    except DecompositionError as error:
        return ObjectResult(obj.name_full, error=str(error))
    return ObjectResult(
        obj.name_full,
        record=record_of(obj),
        summary=summary(decomposition),
        notes=decomposition.notes,
        seconds=time.perf_counter() - started,
    )


def _show(file_name: str, result: ObjectResult, screen: Screen) -> None:
    """Say what became of one object."""
    title = f"{file_name}, {result.name}"
    for note in result.notes:
        screen.warning(f"{title}: {note}")
    if result.error:
        screen.error(f"{title}: {result.error}")
    if result.summary:
        # Not every console has the arrow.
        line = result.summary.replace("→", "->")
        screen.result(f"{title}: {line}, {result.seconds:.1f} s")
