"""Builds collision hulls for the objects that were decomposed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import bpy

from ....core.errors import DecompositionError
from ....core.parameters.hulls import HullParameters
from ....core.results import HullDecomposition
from ...bridge.hulls.hull_objects import write_hulls
from ...bridge.read.shape import have_equal_shapes
from ...bridge.stored.record import record_of
from ...bridge.work.computing import build_hulls_of, hull_summary
from ..request.options import Request
from ..screen import Screen, progress_title
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
    decomposed = [
        obj
        for obj, result in zip(objects, results, strict=True)
        if result.record is not None
    ]
    known: list[_Built] = []
    hulls = [
        hull
        for place, obj in enumerate(decomposed, start=1)
        for hull in _hulls_of(obj, known, request, screen, (place, len(decomposed)))
    ]
    _show(hulls)
    return hulls


def _show(hulls: Sequence[bpy.types.Object]) -> None:
    """Put hulls into the scene that are in hidden collections or other scenes.

    Blender's exporters write what can be selected.
    """
    bpy.context.view_layer.update()
    for hull in hulls:
        if not hull.visible_get():
            bpy.context.scene.collection.objects.link(hull)


@dataclass(frozen=True)
class _Built:
    """The hulls of an object; others with its mesh and scale get the same."""

    owner: bpy.types.Object
    found: HullDecomposition
    hulls: list[bpy.types.Object]


def _serves(built: _Built, obj: bpy.types.Object, parameters: HullParameters) -> bool:
    """Return whether an object gets hulls that were built for another one."""
    in_lengths = getattr(parameters, "error_unit", "RELATIVE") == "SCENE"
    return have_equal_shapes(built.owner, obj, in_lengths)


def with_hull_records(
    objects: Sequence[bpy.types.Object], results: Sequence[ObjectResult]
) -> tuple[ObjectResult, ...]:
    """Return `results` with the records that the objects have now, hulls included."""
    return tuple(
        replace(result, record=record_of(obj)) if result.record is not None else result
        for obj, result in zip(objects, results, strict=True)
    )


def _hulls_of(
    obj: bpy.types.Object,
    known: list[_Built],
    request: Request,
    screen: Screen,
    place: tuple[int, int],
) -> list[bpy.types.Object]:
    """Build the hulls of one object and show its result; add them to `known`.

    `place` is the number of the object, and how many there are.
    """
    title = f"{obj.name_full}, hulls"
    parameters = request.hull_parameters
    try:
        built = next((each for each in known if _serves(each, obj, parameters)), None)
        if built is None:
            steps = build_hulls_of(obj, request.parameters, parameters)
            found = screen.follow(progress_title(title, *place), steps)
            hulls = write_hulls(obj, found, parameters)
            known.append(_Built(obj, found, hulls))
        else:
            found = built.found
            meshes = [hull.data for hull in built.hulls]
            hulls = write_hulls(obj, found, parameters, meshes)
    except DecompositionError as error:
        raise DecompositionError(f"{title}: {error}") from error
    if built is None:
        for note in found.notes:
            screen.warning(f"{title}: {note}")
    screen.result(f"{title}: {hull_summary(found)}")
    return hulls
