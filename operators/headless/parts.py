"""Decomposes the mesh objects of a file, one after the other."""

from __future__ import annotations

import json
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import bpy

from ...core.errors import DecompositionError
from ...core.parameters import Parameters
from ...core.progress import Steps
from ..bridge.ray_caster import BvhRayCaster
from ..bridge.read import read_shape, reading_notes
from ..bridge.write import check_writable, write_parts
from .screen import Screen

T = TypeVar("T")


@dataclass(frozen=True)
class ObjectResult:
    """What became of one object.

    Attributes
    ----------
    name : str
        Name of the object in the file.
    record : dict or None
        What is noted on the object as well, None if it was not decomposed.
    notes : tuple of str
        Findings that stopped nothing.
    error : str or None
        Why the object could not be decomposed.
    seconds : float
        Time that the decomposition took.
    """

    name: str
    record: dict[str, Any] | None = None
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
    done: dict[bpy.types.Mesh, str] = {}
    results = []
    for obj in objects:
        if not obj.data.polygons:
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
    # Loads SciPy and scikit-learn, seconds that enabling the add-on must not take.
    from ...core.decomposition import decompose

    started = time.perf_counter()
    try:
        check_writable(obj)
        notes = reading_notes(obj)
        steps = decompose(read_shape(obj), parameters, BvhRayCaster)
        decomposition = _run(steps, f"{file_name}, {obj.name_full}", screen)
        notes += decomposition.notes
        decomposition = replace(decomposition, notes=notes)
        write_parts(obj, decomposition, parameters)
    except DecompositionError as error:
        return ObjectResult(obj.name_full, error=str(error))
    return ObjectResult(
        obj.name_full,
        record=json.loads(obj["wcd"]),
        notes=notes,
        seconds=time.perf_counter() - started,
    )


def _run(steps: Steps[T], title: str, screen: Screen) -> T:
    """Exhaust `steps`, showing their progress, and return their value."""
    while True:
        try:
            screen.progress(title, next(steps))
        except StopIteration as stop:
            value: T = stop.value
            return value


def _show(file_name: str, result: ObjectResult, screen: Screen) -> None:
    """Say what became of one object."""
    title = f"{file_name}, {result.name}"
    for note in result.notes:
        screen.warning(f"{title}: {note}")
    if result.error:
        screen.error(f"{title}: {result.error}")
    if result.record:
        k, parts = result.record["k"], result.record["parts"]
        mean = sum(part["convexity_rank"] for part in parts) / k
        screen.result(
            f"{title}: {k} {'part' if k == 1 else 'parts'},"
            f" psi {result.record['psi_before']:.3f} -> {result.record['psi']:.3f},"
            f" mean convexity rank {mean:.3f}, {result.seconds:.1f} s"
        )
