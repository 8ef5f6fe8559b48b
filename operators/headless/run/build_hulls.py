"""Builds collision hulls for the objects of a file."""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import bpy

from ....core.errors import DecompositionError
from ....core.parameters.hulls import HullParameters
from ....core.results.hulls import HullDecomposition
from ...bridge.hulls.hull_objects import figures_of_hull, write_hulls
from ...bridge.hulls.placed import pose_in_scene
from ...bridge.parts.rows import hull_shapes
from ...bridge.read.reading_notes import reading_notes
from ...bridge.read.shape import have_equal_shapes
from ...bridge.stored.record import record_of
from ...bridge.work.computing_hulls import hull_summary
from ..request.options import Request
from ..screen import Screen, progress_title
from ..write.hull_files import names_in_file
from .hulls_ahead import HullsAhead
from .results import ObjectResult


def build_hulls(
    path: Path,
    objects: Sequence[bpy.types.Object],
    results: Sequence[ObjectResult],
    request: Request,
    screen: Screen,
) -> tuple[list[bpy.types.Object], tuple[ObjectResult, ...]]:
    """Build the hulls of each object of `path` that has a record, if an empty one.

    Returns
    -------
    hulls : list of Object
    results : tuple of ObjectResult
        With the hulls, or the error, of each object.
    """
    rows = [row for row, result in enumerate(results) if result.record is not None]
    known: dict[bpy.types.ID, list[_Built]] = {}
    hulls: list[bpy.types.Object] = []
    told = list(results)
    with closing(HullsAhead([objects[row] for row in rows], request)) as ahead:
        for number, row in enumerate(rows, start=1):
            obj, result, started = objects[row], results[row], time.perf_counter()
            built, place = known.setdefault(obj.data, []), (number, len(rows))
            title = f"{path}, {obj.name_full}, hulls"
            try:
                new, figures = _hulls_of(
                    obj, built, request, screen, title, place, ahead
                )
                hulls += new
                result = replace(result, record=record_of(obj), hulls=figures)
            except DecompositionError as error:
                screen.error(str(error), title)
                result = replace(result, error=str(error))
            seconds = result.seconds + time.perf_counter() - started
            told[row] = replace(result, seconds=seconds)
    _show(hulls)
    return hulls, _named_as_in_file(told, hulls, request)


def _named_as_in_file(
    results: Sequence[ObjectResult], hulls: Sequence[bpy.types.Object], request: Request
) -> tuple[ObjectResult, ...]:
    """Return results whose hulls have the names of the file of hulls, if one is asked.

    `hulls` are those of all results, in their order.
    """
    files = [each.hulls for each in request.targets if each.hulls]
    if not files:
        return tuple(results)
    ending = files[0].suffix.lower()  # of all files
    names = iter(names_in_file(ending, hulls, request.body_parameters))
    return tuple(
        replace(
            result,
            hulls=tuple({**figures, "name": next(names)} for figures in result.hulls),
        )
        for result in results
    )


def _show(hulls: Sequence[bpy.types.Object]) -> None:
    """Put hulls into the scene that are in hidden collections or other scenes.

    Blender does not compute the places of others.
    """
    bpy.context.view_layer.update()
    for hull in hulls:
        if not hull.visible_get():
            bpy.context.scene.collection.objects.link(hull)


@dataclass(frozen=True)
class _Built:
    """The hulls of an object; others that would have equal ones get the same."""

    owner: bpy.types.Object
    read: tuple[str, ...]  # notes on what was read of it
    found: HullDecomposition
    hulls: list[bpy.types.Object]


def _serves(built: _Built, obj: bpy.types.Object, parameters: HullParameters) -> bool:
    """Return whether an object gets hulls that were built for another one."""
    of_equal_size = parameters.error_unit == "SCENE"
    return (
        have_equal_shapes(built.owner, obj, of_equal_size)
        # Those chosen for single parts: they are on the object, not on its mesh.
        and hull_shapes(built.owner) == hull_shapes(obj)
    )


def _hulls_of(
    obj: bpy.types.Object,
    known: list[_Built],
    request: Request,
    screen: Screen,
    title: str,
    place: tuple[int, int],
    ahead: HullsAhead,
) -> tuple[list[bpy.types.Object], tuple[dict[str, Any], ...]]:
    """Build the hulls of one object and show its result; return figures, too.

    `known` has what was built for objects of the same mesh, and gets what is new.
    `title` is what the user sees before its progress and result, and `place` the number
    of the object, and how many there are.
    """
    parameters = request.hull_parameters
    built = next((each for each in known if _serves(each, obj, parameters)), None)
    read = reading_notes(obj, for_parts=False, has_choice=True)
    if built is None:
        found = screen.follow(progress_title(title, *place), ahead.steps_of(obj))
        of_hulls = [note for note in found.notes if note not in read]
    else:
        found, of_hulls = built.found, []
        # What was read of the other object is not said of this one.
        kept = (note for note in found.notes if note not in built.read)
        found = replace(found, notes=(*read, *kept))
    for note in (*read, *of_hulls):
        screen.warning(note, title)
    with screen.stages.during("hulls"):
        meshes = [hull.data for hull in built.hulls] if built else None
        hulls = write_hulls(obj, found, parameters, meshes)
        figures = tuple(
            {
                "name": hull.name,
                **figures_of_hull(found, row),
                **pose_in_scene(shape, obj),
            }
            for row, (hull, shape) in enumerate(zip(hulls, found.shapes, strict=True))
        )
    if built is None:
        known.append(_Built(obj, read, found, hulls))
    screen.result(f"{title}: {hull_summary(found)}")
    return hulls, figures
