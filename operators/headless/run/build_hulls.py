"""Builds collision hulls for the objects that were decomposed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import bpy

from ....core.errors import DecompositionError
from ...bridge.hulls.hull_objects import write_hulls
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
) -> list[bpy.types.Object]:
    """Build the hulls of each object that was decomposed; return the hulls.

    Raises
    ------
    DecompositionError
        If the hulls of one object cannot be built.
    """
    return [
        hull
        for obj, result in zip(objects, results, strict=True)
        if result.record is not None
        for hull in _hulls_of(obj, request, screen)
    ]


def with_hull_records(
    objects: Sequence[bpy.types.Object], results: Sequence[ObjectResult]
) -> tuple[ObjectResult, ...]:
    """Return `results` with the records that the objects have now, hulls included."""
    return tuple(
        replace(result, record=record_of(obj)) if result.record is not None else result
        for obj, result in zip(objects, results, strict=True)
    )


def _hulls_of(
    obj: bpy.types.Object, request: Request, screen: Screen
) -> list[bpy.types.Object]:
    """Build the hulls of one object and show its result."""
    title = f"{obj.name_full}, hulls"
    parameters = request.hull_parameters
    try:
        steps = build_hulls_of(obj, request.parameters, parameters)
        found = screen.follow(title, steps)
        hulls = write_hulls(obj, found, parameters)
    except DecompositionError as error:
        raise DecompositionError(f"{title}: {error}") from error
    for note in found.notes:
        screen.warning(f"{title}: {note}")
    screen.result(f"{title}: {hull_summary(found)}")
    return hulls
