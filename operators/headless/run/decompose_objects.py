"""Decomposes the objects of a file, one after the other."""

from __future__ import annotations

import time
from collections.abc import Sequence

import bpy

from ....core.errors import DecompositionError
from ....core.parameters.parts import Parameters
from ...bridge.mesh.points import is_cloud
from ...bridge.stored.record import record_of
from ...bridge.work.computing import summary
from ...bridge.work.locking import decompose_unlocked
from ..screen import Screen
from .results import ObjectResult


def decompose_objects(
    file_name: str,
    objects: Sequence[bpy.types.Object],
    parameters: Parameters,
    screen: Screen,
) -> tuple[ObjectResult, ...]:
    """Decompose each object, write its parts to it and show its result.

    Returns
    -------
    tuple of ObjectResult
        One for each object, in their order. Objects without faces are left as they
        are; objects that share a mesh are decomposed once.
    """
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
            title = f"{file_name}, {obj.name_full}"
            result = _decompose(title, obj, parameters, screen)
        _show(file_name, result, screen)
        results.append(result)
    return tuple(results)


def _decompose(
    title: str, obj: bpy.types.Object, parameters: Parameters, screen: Screen
) -> ObjectResult:
    """Decompose one object and write its parts to it."""
    started = time.perf_counter()
    try:
        edited = screen.follow(title, decompose_unlocked(obj, parameters))
        edited.write(obj)
        found = edited.decomposition
    except DecompositionError as error:
        return ObjectResult(obj.name_full, error=str(error))
    return ObjectResult(
        obj.name_full,
        record=record_of(obj),
        summary=summary(found),
        notes=found.notes,
        seconds=time.perf_counter() - started,
    )


def _show(file_name: str, result: ObjectResult, screen: Screen) -> None:
    """Show the result of one object."""
    title = f"{file_name}, {result.name}"
    for note in result.notes:
        screen.warning(f"{title}: {note}")
    if result.error:
        screen.error(f"{title}: {result.error}")
    if result.summary:
        # Not every console has the arrow.
        line = result.summary.replace("→", "->")
        screen.result(f"{title}: {line}, {result.seconds:.1f} s")
