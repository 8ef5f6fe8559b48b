"""Decomposes the objects of a file, one after the other."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

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

_USUAL = Parameters()
_NO_FACES = "It has no faces and was left as it is."
_KEEPS = "It keeps its parts; options that find parts change nothing."


def decompose_objects(
    path: Path,
    loaded: LoadedFile,
    parameters: Parameters,
    screen: Screen,
    kept: bool,
) -> tuple[ObjectResult, ...]:
    """Decompose each object of `path`, write its parts to it and show its result.

    Return a result for each object, in their order. Objects without faces are left as
    they are, and so are those with parts if these are `kept`. Objects that share a mesh
    are decomposed once.
    """
    done: dict[bpy.types.ID, tuple[bpy.types.Object, ObjectResult]] = {}

    def result_of(obj: bpy.types.Object, place: int) -> ObjectResult:
        if not has_shape(obj):
            return ObjectResult(obj.name_full, notes=(_NO_FACES,))
        if obj.data in done:
            return _shared(obj, *done[obj.data])
        if kept and part_labels(obj) is not None:
            result = _kept(obj, parameters)
        else:
            title = f"{path}, {obj.name_full}"
            title = progress_title(title, place, len(loaded.objects))
            result = _decompose(title, obj, parameters, screen)
        done[obj.data] = obj, result
        return result

    results = []
    for place, obj in enumerate(loaded.objects, start=1):
        try:
            result = result_of(obj, place)
        except DecompositionError as error:
            result = ObjectResult(obj.name_full, error=str(error))
        result = replace(result, notes=(*loaded.notes_of(obj), *result.notes))
        show(path, result, screen)
        results.append(result)
    return tuple(results)


def _kept(obj: bpy.types.Object, parameters: Parameters) -> ObjectResult:
    """Return the result of an object that keeps the parts that it has."""
    # The seed has an effect: hulls use it.
    is_usual = replace(parameters, seed=_USUAL.seed) == _USUAL
    notes = () if is_usual else (_KEEPS,)
    return ObjectResult(obj.name_full, record_of(obj), notes=notes)


def _shared(
    obj: bpy.types.Object, first: bpy.types.Object, result: ObjectResult
) -> ObjectResult:
    """Return the result of an object that has the mesh, and so the parts, of `first`.

    Parts were found for the proportions of the first object.
    """
    notes: tuple[str, ...] = ()
    if not has_proportions_of(obj, first):
        notes = (
            f"It shares the mesh of {first.name_full}, and so its parts, which were"
            " found for the proportions of that one.",
        )
    summary = result.summary and f"{result.summary}, with the mesh of {first.name_full}"
    return ObjectResult(obj.name_full, record_of(obj), summary, notes)


def _decompose(
    title: str, obj: bpy.types.Object, parameters: Parameters, screen: Screen
) -> ObjectResult:
    """Decompose one object and write its parts to it."""
    started = time.perf_counter()
    try:
        edited = screen.follow(title, decompose_unlocked(obj, parameters))
    except AllPartsStay as stay:
        return ObjectResult(obj.name_full, record_of(obj), notes=(str(stay),))
    edited.write(obj)
    found = edited.decomposition
    return ObjectResult(
        obj.name_full,
        record=record_of(obj),
        summary=summary(found),
        notes=found.notes,
        seconds=time.perf_counter() - started,
    )


def show(path: Path, result: ObjectResult, screen: Screen) -> None:
    """Show the result of one object of the input `path`."""
    title = f"{path}, {result.name}"
    for note in result.notes:
        screen.warning(note, title)
    if result.error:
        screen.error(result.error, title)
    if result.summary:
        # Not every console has the arrow.
        line = result.summary.replace("→", "->")
        screen.result(f"{title}: {line}, {result.seconds:.1f} s")
