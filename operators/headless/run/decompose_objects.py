"""Decomposes the objects of a file, one after the other."""

from __future__ import annotations

import time
from dataclasses import replace

import bpy

from ....core.errors import DecompositionError
from ....core.parameters.parts import Parameters
from ...bridge.parts.read import part_labels
from ...bridge.read.shape import has_proportions_of
from ...bridge.stored.record import record_of
from ...bridge.work.computing import summary
from ...bridge.work.locking import AllPartsStay, decompose_unlocked
from ..current_file import has_shape
from ..read.load import LoadedFile
from ..screen import Screen, progress_title
from .results import ObjectResult


def decompose_objects(
    file_name: str,
    loaded: LoadedFile,
    parameters: Parameters,
    screen: Screen,
    kept: bool = False,
) -> tuple[ObjectResult, ...]:
    """Decompose each object, write its parts to it and show its result.

    Parameters
    ----------
    file_name : str
    loaded : LoadedFile
    parameters : Parameters
    screen : Screen
    kept : bool, optional
        Whether objects that have parts keep them as they are.

    Returns
    -------
    tuple of ObjectResult
        One for each object, in their order. Objects without faces are left as they
        are; objects that share a mesh are decomposed once.
    """
    done: dict[bpy.types.ID, tuple[bpy.types.Object, ObjectResult]] = {}
    results = []
    for place, obj in enumerate(loaded.objects, start=1):
        if not has_shape(obj):
            note = "It has no faces and was left as it is."
            result = ObjectResult(obj.name_full, notes=(note,))
        elif obj.data in done:
            result = _shared(obj, *done[obj.data])
        elif kept and part_labels(obj) is not None:
            result = ObjectResult(obj.name_full, record_of(obj))
            done[obj.data] = obj, result
        else:
            title = progress_title(
                f"{file_name}, {obj.name_full}", place, len(loaded.objects)
            )
            result = _decompose(title, obj, parameters, screen)
            if not result.error:
                done[obj.data] = obj, result
        result = replace(result, notes=(*loaded.notes_of(obj), *result.notes))
        _show(file_name, result, screen)
        results.append(result)
    return tuple(results)


def _shared(
    obj: bpy.types.Object, first: bpy.types.Object, result: ObjectResult
) -> ObjectResult:
    """Return the result of an object that has the mesh, and so the parts, of `first`.

    Parts were found for the proportions of the first object.
    """
    notes: tuple[str, ...] = ()
    try:
        if not has_proportions_of(obj, first):
            notes = (
                f"It shares the mesh of {first.name_full}, and so its parts, which"
                " were found for the proportions of that one.",
            )
    except DecompositionError as error:
        return ObjectResult(obj.name_full, error=str(error))
    summary = f"{result.summary}, with the mesh of {first.name_full}"
    return ObjectResult(obj.name_full, record_of(obj), summary, notes)


def _decompose(
    title: str, obj: bpy.types.Object, parameters: Parameters, screen: Screen
) -> ObjectResult:
    """Decompose one object and write its parts to it."""
    started = time.perf_counter()
    try:
        edited = screen.follow(title, decompose_unlocked(obj, parameters))
        edited.write(obj)
        found = edited.decomposition
    except AllPartsStay as stay:
        return ObjectResult(obj.name_full, record_of(obj), notes=(str(stay),))
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
