"""Decomposes one input: loads it and writes its model, picture and hulls."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

import bpy

from ....core.errors import DecompositionError
from ..current_file import has_shape
from ..files.claims import Goals
from ..formats import USUAL_UP
from ..read.load import LoadedFile, load_file
from ..request.options import Request
from ..request.outputs import Targets
from ..screen import Screen
from ..stages import Stages
from ..write.hull_files import save_hulls
from ..write.model_files import save
from ..write.picture import save_picture
from ..write.render_engine import EngineTrial
from .attempts import Attempts
from .build_hulls import build_hulls
from .decompose_objects import decompose_objects, show
from .results import InputResult, ObjectResult

_NO_HULLS = (
    "{} was not written, because no object got hulls; leave out --with-hulls for the"
    " model alone."
)

_NO_FACES = "It has no faces and gets no hulls."


def decompose_file(
    path: Path,
    targets: Targets,
    request: Request,
    trial: EngineTrial,
    screen: Screen,
    goals: Goals,
) -> InputResult:
    """Decompose the input `path` and write its targets.

    What fails is shown and noted; the rest is still done. The engine trial says which
    engine renders the picture, and goals refuse to replace what inputs refer to.
    """
    started = time.perf_counter()
    attempts, stages = Attempts(screen), Stages()
    screen.stages = stages
    with stages.during("read"):
        loaded = _load(path, targets, request, goals, attempts)
    objects, bodies = loaded.objects, request.body_parameters
    results = _parts_of(loaded, path, targets, request, screen)
    built: list[bpy.types.Object] = []
    if all(result.record is None for result in results):
        targets = Targets()  # there is nothing to write

    up = request.up or USUAL_UP.get(path.suffix.lower())
    if request.with_hulls and targets.output:
        built, results = build_hulls(path, objects, results, request, screen)
        if not built:  # a model without its hulls is not what was asked for
            attempts.failed(_NO_HULLS.format(targets.output))
            targets = replace(targets, output=None, hulls=None)
    with stages.during("write"):
        output = attempts.written(targets.output, lambda file: save(file, up, built))
        picture = attempts.written(
            targets.picture, lambda file: save_picture(file, objects, trial.engine())
        )
    if targets.hulls and not built:
        built, results = build_hulls(path, objects, results, request, screen)
    with stages.during("write"):
        hulls = attempts.written(
            targets.hulls if built else None,
            lambda file: save_hulls(file, built, up, bodies),
        )
    errors, seconds = tuple(attempts.errors), time.perf_counter() - started
    notes, used = loaded.about, stages.stages
    written = Targets(output, picture, hulls)
    return InputResult(path, results, notes, errors, written, seconds, used)


def _load(
    path: Path, targets: Targets, request: Request, goals: Goals, attempts: Attempts
) -> LoadedFile:
    """Load an input, unless its targets would replace what an input refers to."""
    try:
        goals.check(targets.places())
        loaded = load_file(path, request.up, request.apply_modifiers)
        goals.keep(loaded.refers_to, path)
    except DecompositionError as error:
        attempts.failed(str(error))
        return LoadedFile([], {})
    return loaded


def _parts_of(
    loaded: LoadedFile, path: Path, targets: Targets, request: Request, screen: Screen
) -> tuple[ObjectResult, ...]:
    """Return the result of each object; without parts if only hulls are asked for."""
    for note in loaded.about:
        screen.warning(note, str(path))
    hulls_alone = not targets.show_parts
    if hulls_alone and request.hull_parameters.pieces != "PARTS":
        return _without_parts(path, loaded, screen)
    return decompose_objects(path, loaded, request.parameters, screen, hulls_alone)


def _without_parts(
    path: Path, loaded: LoadedFile, screen: Screen
) -> tuple[ObjectResult, ...]:
    """Return a result for each object, without parts; say which have no faces."""
    results = []
    for obj in loaded.objects:
        has_faces = has_shape(obj)
        notes = (*loaded.notes_of(obj), *(() if has_faces else (_NO_FACES,)))
        result = ObjectResult(
            obj.name_full, record={} if has_faces else None, notes=notes
        )
        show(path, result, screen)
        results.append(result)
    return tuple(results)
