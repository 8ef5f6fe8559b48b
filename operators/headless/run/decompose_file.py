"""Decomposes one input: loads it and writes its model, picture and hulls."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

import bpy

from ..formats import USUAL_UP
from ..read.known_hulls import hull_note
from ..read.load import load
from ..request.options import Request
from ..request.outputs import Targets
from ..screen import Screen
from ..write.hull_files import save_hulls
from ..write.model_files import save
from ..write.picture import save_picture
from ..write.render_engine import EngineTrial
from .attempts import Attempts
from .build_hulls import build_hulls, with_hull_records
from .decompose_objects import decompose_objects
from .results import InputResult


def decompose_file(
    path: Path,
    targets: Targets,
    request: Request,
    trial: EngineTrial,
    screen: Screen,
) -> InputResult:
    """Decompose the input `path` and write its targets.

    What fails is shown and noted; the rest is still done. The engine trial says which
    engine renders the picture.
    """
    started = time.perf_counter()
    attempts = Attempts(screen)
    objects = attempts.value(lambda: load(path, request.up)) or []
    note = hull_note()
    if note:
        screen.warning(f"{path.name}: {note}")
    results = decompose_objects(path.name, objects, request.parameters, screen)
    if not any(result.record for result in results):
        targets = Targets()  # there is nothing to write

    up = request.up or USUAL_UP.get(path.suffix.lower())
    built: list[bpy.types.Object] = []
    if request.with_hulls and targets.output:
        made = attempts.value(lambda: build_hulls(objects, results, request, screen))
        built = made or []
        if made is None:  # a model without its hulls is not what was asked for
            targets = replace(targets, output=None, hulls=None)
    output = attempts.written(targets.output, lambda file: save(file, up, built))
    picture = attempts.written(
        targets.picture, lambda file: save_picture(file, objects, trial.engine())
    )

    def write_hulls(file: Path) -> None:
        found = built or build_hulls(objects, results, request, screen)
        for note in save_hulls(file, found, up or "Z", request.body_parameters):
            screen.warning(f"{path.name}, hulls: {note}")

    hulls = attempts.written(targets.hulls, write_hulls)
    if hulls or built:
        results = with_hull_records(objects, results)
    errors, seconds = tuple(attempts.errors), time.perf_counter() - started
    return InputResult(path, results, errors, output, picture, hulls, seconds)
