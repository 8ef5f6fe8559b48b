"""Compute results for an object: decompose it, measure it, draw pictures of it.

Each function checks and reads the object at once, and raises then if it cannot. It
returns the computation as `Steps`, which give the result when they are run.
"""

from __future__ import annotations

from typing import TypeAlias

import bpy
import numpy as np

from .... import core
from ....core.errors import DecompositionError
from ....core.geometry.shape import Shape
from ....core.parameters.parts import Parameters
from ....core.results.parts import Decomposition, Measurement
from ....core.results.views import Picture
from ....core.steps.progress import Progress, Steps, as_steps, within
from ..mesh.selection import selected_faces
from ..parts.palette import srgb_of
from ..parts.read import find_parts_on
from ..parts.write import check_writable
from ..read.evaluated import SeenMesh
from ..read.reading_notes import reading_notes
from ..read.shape import shape_in_steps
from ..stored.record import check_records, noted_parameters
from .libraries import with_libraries
from .session_cache import session_cache

Notes: TypeAlias = tuple[str, ...]


def decompose_object(
    obj: bpy.types.Object,
    parameters: Parameters,
    seen: SeenMesh | None = None,
    rough: bool = False,
) -> Steps[Decomposition]:
    """Return the steps that decompose an object, or its mesh as it is `seen`.

    If they may be `rough`, parts that would take long are only a first look.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to.
    """
    check_writable(obj)
    notes, reading = read_seen(obj, seen)

    def work() -> Steps[Decomposition]:
        shape, cache = (yield from reading), session_cache()
        steps = core.decompose_in_steps(shape, parameters, cache, None, rough)
        return (yield from steps)

    return with_libraries(notes, work())


def read_seen(
    obj: bpy.types.Object, seen: SeenMesh | None, for_parts: bool = True
) -> tuple[Notes, Steps[Shape]]:
    """Return what to say of an object's shape, and the steps that end in it.

    It is the one that is `seen`, if that is given. `for_parts` says whether parts of
    the shape will be written to the object.
    """
    if seen is not None:
        return seen.notes(for_parts), as_steps(seen.shape)
    return reading_notes(obj, for_parts, has_choice=True), shape_in_steps(obj)


def measure_object(
    obj: bpy.types.Object, parameters: Parameters, of_selection: bool = False
) -> Steps[Measurement]:
    """Return the steps that measure the convexity rank of an object.

    Or that of its selected faces.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read, or no face is selected.
    """
    check_records(obj)
    notes, reading = reading_notes(obj, for_parts=False), shape_in_steps(obj)
    faces = selected_faces(obj) if of_selection else None
    if faces is not None and not faces.any():
        raise DecompositionError(
            "No faces are selected; select the faces to measure in Edit Mode."
        )

    def work() -> Steps[Measurement]:
        shape, cache = (yield from reading), session_cache()
        return (yield from core.measure_in_steps(shape, parameters, cache, faces))

    return with_libraries(notes, work())


def point_viewer_of(
    obj: bpy.types.Object, parameters: Parameters
) -> Steps[core.PointViewer]:
    """Return the steps that prepare showing what points of an object see.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read.
    """
    notes, reading = reading_notes(obj, for_parts=False), shape_in_steps(obj)

    def work() -> Steps[core.PointViewer]:
        shape = yield from reading
        prepared = yield from within(session_cache().prepare(shape), 0.0, 0.4)
        viewer = core.point_viewer_in_steps(prepared, parameters)
        return (yield from within(viewer, 0.4, 1.0))

    return with_libraries(notes, work())


def picture_of(obj: bpy.types.Object, kind: str) -> Steps[Picture]:
    """Return the steps that draw one of `PICTURES`: how the parts were found.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read, or has no record of its parts.
    """
    parameters = noted_parameters(obj)
    found, reading = find_parts_on(obj), shape_in_steps(obj)
    if found is None or parameters is None:
        raise DecompositionError(
            f"{obj.name} has no record of its parts; decompose it again."
        )
    colors = np.array([srgb_of(each.color) for each in found.identities])

    def work() -> Steps[Picture]:
        shape, cache = (yield from reading), session_cache()
        prepared = yield from within(cache.prepare(shape), 0.0, 0.1)
        memo = yield from within(cache.see(prepared, parameters), 0.1, 0.9)
        yield Progress("Picture", 0.9)
        return core.draw_picture(kind, memo, found.labels, parameters, colors)

    return with_libraries((), work())


def summary(decomposition: Decomposition) -> str:
    """Return one line with the number of parts, psi and the mean convexity rank."""
    n_parts = decomposition.n_parts
    return (
        f"{n_parts} {'part' if n_parts == 1 else 'parts'},"
        f" psi {decomposition.psi_before:.3f} → {decomposition.psi:.3f},"
        f" mean convexity rank {decomposition.ranks.mean():.3f}"
    )
