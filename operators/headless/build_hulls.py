"""Builds the hulls of decomposed objects, and writes them to a file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import bpy

from ...core.errors import DecompositionError
from ...core.parameters.hulls import HullParameters
from ...core.parameters.parts import Parameters
from ...core.steps.progress import Progress, mapped, run
from ..bridge.hulls.hull_objects import write_hulls
from ..bridge.stored.record import record_of
from ..bridge.work.computing import build_hulls_of, hull_summary
from .decompose_file import ObjectResult
from .screen import Screen
from .write.hull_files import save_hulls


def build_and_save(
    path: Path,
    up: str,
    objects: Sequence[bpy.types.Object],
    results: Sequence[ObjectResult],
    parameters: tuple[Parameters, HullParameters],
    screen: Screen,
) -> tuple[ObjectResult, ...]:
    """Build hulls around the parts of each decomposed object, and write all to `path`.

    Returns
    -------
    tuple of ObjectResult
        `results` with the hulls in their records.

    Raises
    ------
    DecompositionError
        If hulls cannot be made or written.
    """
    with_hulls, hulls = [], []
    for obj, result in zip(objects, results, strict=True):
        if result.record is None:
            with_hulls.append(result)
            continue
        hulls += _hulls(obj, parameters, screen)
        with_hulls.append(replace(result, record=record_of(obj)))
    save_hulls(path, hulls, up)
    return tuple(with_hulls)


def _hulls(
    obj: bpy.types.Object,
    parameters: tuple[Parameters, HullParameters],
    screen: Screen,
) -> list[bpy.types.Object]:
    """Build the hulls of one object, and say on the screen what came of it."""
    title = f"{obj.name_full}, hulls"

    def show(progress: Progress) -> Progress:
        screen.progress(title, progress)
        return progress

    try:
        found = run(mapped(build_hulls_of(obj, *parameters), show))
        hulls = write_hulls(obj, found, parameters[1])
    except DecompositionError as error:
        raise DecompositionError(f"{title}: {error}") from error
    for note in found.notes:
        screen.warning(f"{title}: {note}")
    screen.result(f"{title}: {hull_summary(found)}")
    return hulls
