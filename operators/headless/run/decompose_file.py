"""Decomposes one input: loads it and writes its model, picture and hulls."""

from __future__ import annotations

import time
from pathlib import Path

from ..formats import USUAL_UP
from ..read.load import LoadedFile, load_file
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
    loaded = attempts.value(
        lambda: load_file(path, request.up, request.apply_modifiers)
    ) or LoadedFile([], {})
    objects = loaded.objects
    results = decompose_objects(path.name, loaded, request.parameters, screen)
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
    errors, seconds = tuple(attempts.errors), time.perf_counter() - started
    return InputResult(path, results, errors, output, picture, hulls, seconds)
