"""Builds collision hulls for the objects of a file."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import bpy

from ....core.errors import DecompositionError
from ...bridge.hulls.hull_objects import write_hulls
from ...bridge.hulls.placed import placed
from ...bridge.stored.record import record_of
from ...bridge.work.computing import build_hulls_of, hull_summary
from ..request.options import Request
from ..screen import Screen
from .results import ObjectResult


def build_hulls(
    objects: Sequence[bpy.types.Object],
    results: Sequence[ObjectResult],
    request: Request,
    screen: Screen,
) -> tuple[list[bpy.types.Object], tuple[ObjectResult, ...]]:
    """Build the hulls of each object that has a record, if an empty one.

    Returns
    -------
    hulls : list of Object
    results : tuple of ObjectResult
        With the hulls, or the error, of each object.
    """
    hulls: list[bpy.types.Object] = []
    told = []
    for obj, result in zip(objects, results, strict=True):
        if result.record is None:
            told.append(result)
            continue
        started = time.perf_counter()
        try:
            new, figures = _hulls_of(obj, request, screen)
            hulls += new
            result = replace(result, record=record_of(obj), hulls=figures)
        except DecompositionError as error:
            screen.error(f"{_title(obj)}: {error}")
            result = replace(result, error=str(error))
        seconds = result.seconds + time.perf_counter() - started
        told.append(replace(result, seconds=seconds))
    return hulls, tuple(told)


def _title(obj: bpy.types.Object) -> str:
    """Return what the user sees before the progress and result of hulls."""
    return f"{obj.name_full}, hulls"


def _hulls_of(
    obj: bpy.types.Object, request: Request, screen: Screen
) -> tuple[list[bpy.types.Object], tuple[dict[str, Any], ...]]:
    """Build the hulls of one object and show its result; return figures, too."""
    title, parameters = _title(obj), request.hull_parameters
    steps = build_hulls_of(obj, request.parameters, parameters)
    found = screen.follow(title, steps)
    with screen.stages.during("hulls"):
        hulls = write_hulls(obj, found, parameters)
        noted = record_of(obj)["hulls"]["hulls"]
        figures = tuple(
            {**figure, **placed(shape, obj)}
            for figure, shape in zip(noted, found.shapes, strict=True)
        )
    for note in found.notes:
        screen.warning(f"{title}: {note}")
    screen.result(f"{title}: {hull_summary(found)}")
    return hulls, figures
