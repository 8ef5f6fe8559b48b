"""Decomposes one input: loads it and writes its model, picture and hulls."""

from __future__ import annotations

import time
from pathlib import Path

import bpy

from .attempts import Attempts
from .build_hulls import build_hulls, with_hull_records
from .decompose_objects import decompose_objects
from .formats import USUAL_UP
from .read.load import load
from .request.options import Request
from .request.outputs import Targets
from .results import InputResult
from .screen import Screen
from .write.hull_files import save_hulls
from .write.model_files import save
from .write.picture import save_picture
from .write.render_engine import EngineTrial


def decompose_file(
    path: Path,
    targets: Targets,
    request: Request,
    trial: EngineTrial,
    screen: Screen,
) -> InputResult:
    """Decompose one input and write what is asked for.

    What fails is shown and noted; the rest is still done.

    Parameters
    ----------
    path : Path
        The input.
    targets : Targets
        The files to write.
    request : Request
        Parameters and the up axis.
    trial : EngineTrial
        Says which engine renders the picture.
    screen : Screen
        Shows progress, results and errors.
    """
    started = time.perf_counter()
    attempts = Attempts(screen)
    nothing: list[bpy.types.Object] = []
    objects = attempts.value(lambda: load(path, request.up), nothing)
    results = decompose_objects(path.name, objects, request.parameters, screen)
    if not any(result.record for result in results):
        targets = Targets()  # there is nothing to write

    up = request.up or USUAL_UP.get(path.suffix.lower())
    output = attempts.written(targets.output, lambda file: save(file, up))
    picture = attempts.written(
        targets.picture, lambda file: save_picture(file, objects, trial.engine())
    )
    hulls = attempts.written(
        targets.hulls,
        lambda file: save_hulls(
            file, build_hulls(objects, results, request, screen), up or "Z"
        ),
    )
    if hulls:
        results = with_hull_records(objects, results)
    seconds = time.perf_counter() - started
    errors = tuple(attempts.errors)
    return InputResult(path, results, errors, output, picture, hulls, seconds)
