"""Compute results for an object: decompose it, measure it, build hulls around it.

Each function checks and reads the object at once, and raises then if it cannot. It
returns the computation as `Steps`, which give the result when they are run.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import replace
from importlib import import_module
from typing import Any, TypeVar

import bpy
import numpy as np

from .... import core
from ....core.errors import DecompositionError
from ....core.parameters.hulls import HullParameters
from ....core.parameters.parts import Parameters
from ....core.results import Decomposition, HullDecomposition, Measurement, Picture
from ....core.steps.progress import Progress, Steps, within
from ..mesh.selection import selected_faces
from ..parts.palette import part_srgb
from ..parts.parted import part_identities, part_labels
from ..parts.write import check_writable
from ..read.shape import read_shape, reading_notes
from ..refusals import hull_refusal
from ..stored.record import check_records, noted_parameters
from .session_cache import has_seen, session_cache

Result = TypeVar("Result")  # of any kind that has notes

# In the order in which they import one another.
_LIBRARIES = (
    "scipy.linalg",
    "scipy.spatial",
    "scipy.optimize",
    "scipy.stats",
    "sklearn.utils",
    "sklearn.neighbors",
    "sklearn.cluster",
)


def decompose_object(
    obj: bpy.types.Object, parameters: Parameters
) -> Steps[Decomposition]:
    """Return the steps that decompose an object.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to.
    """
    check_writable(obj)
    shape = read_shape(obj)

    def work() -> Steps[Decomposition]:
        cache = session_cache()
        return (yield from core.decompose_in_steps(shape, parameters, cache))

    return _with_libraries(reading_notes(obj), work())


def is_quick(obj: bpy.types.Object, parameters: Parameters) -> bool:
    """Return whether decomposing an object needs no new lines of sight.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to.
    """
    check_writable(obj)
    return parameters.levels == 1 and has_seen(read_shape(obj), parameters)


def measure_object(obj: bpy.types.Object, parameters: Parameters) -> Steps[Measurement]:
    """Return the steps that measure the convexity rank of an object.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read.
    """
    check_records(obj)
    shape = read_shape(obj)

    def work() -> Steps[Measurement]:
        return (yield from core.measure_in_steps(shape, parameters, session_cache()))

    return _with_libraries(reading_notes(obj), work())


def measure_selection_of(
    obj: bpy.types.Object, parameters: Parameters
) -> Steps[Measurement]:
    """Return the steps that measure the rank of an object's selected faces.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read, or no face is selected.
    """
    check_records(obj)
    shape, faces = read_shape(obj), selected_faces(obj)
    if not faces.any():
        raise DecompositionError(
            "No faces are selected; select those to be measured in Edit Mode."
        )

    def work() -> Steps[Measurement]:
        cache = session_cache()
        return (yield from core.measure_in_steps(shape, parameters, cache, faces))

    return _with_libraries(reading_notes(obj), work())


def point_viewer_of(
    obj: bpy.types.Object, parameters: Parameters
) -> Steps[core.PointViewer]:
    """Return the steps that prepare showing what points of an object see.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read.
    """
    shape = read_shape(obj)

    def work() -> Steps[core.PointViewer]:
        prepared = yield from within(session_cache().prepare(shape), 0.0, 0.4)
        viewer = core.point_viewer_in_steps(prepared, parameters)
        return (yield from within(viewer, 0.4, 1.0))

    return _with_libraries(reading_notes(obj), work())


def picture_of(obj: bpy.types.Object, kind: str) -> Steps[Picture]:
    """Return the steps that draw one of `PICTURES`: how the parts were found.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read, or has no record of its parts.
    """
    parameters = noted_parameters(obj)
    labels, shape = part_labels(obj), read_shape(obj)
    if labels is None or parameters is None:
        raise DecompositionError(
            f"{obj.name} has no record of its parts; decompose it again."
        )
    identities = part_identities(obj, int(labels.max()) + 1)
    colors = np.array([part_srgb(identity.number) for identity in identities])

    def work() -> Steps[Picture]:
        cache = session_cache()
        prepared = yield from within(cache.prepare(shape), 0.0, 0.1)
        memo = yield from within(cache.see(prepared, parameters), 0.1, 0.9)
        yield Progress("Picture", 0.9)
        return core.draw_picture(kind, memo, labels, parameters, colors)

    return _with_libraries((), work())


def build_hulls_of(
    obj: bpy.types.Object, parameters: Parameters, hull_parameters: HullParameters
) -> Steps[HullDecomposition]:
    """Return the steps that build hulls around an object or its parts.

    An object without parts is first decomposed if each part is to get one shape. These
    parts are not written to the object.

    Parameters
    ----------
    obj : bpy.types.Object
    parameters : Parameters
        Used to decompose the object.
    hull_parameters : HullParameters

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or can have no hulls.
    """
    reason = hull_refusal(obj)
    if reason:
        raise DecompositionError(f"{reason}.")
    check_records(obj)
    shape, labels = read_shape(obj), part_labels(obj)

    def work() -> Steps[HullDecomposition]:
        cache, known, start = session_cache(), labels, 0.0
        if known is None and hull_parameters.pieces == "PARTS":
            start = 0.4
            parts = core.decompose_in_steps(shape, parameters, cache)
            known = (yield from within(parts, 0.0, start)).labels
        steps = core.build_hulls_in_steps(
            shape, hull_parameters, cache, known, parameters.seed
        )
        return (yield from within(steps, start, 1.0))

    return _with_libraries(reading_notes(obj), work())


def load_libraries() -> Steps[None]:
    """Load the libraries of the core, one per step, so that the window responds.

    They take a second to load, which enabling the extension must not.
    """
    for name in _LIBRARIES:
        if name not in sys.modules:
            yield Progress("Libraries", 0.0)
            import_module(name)


def hull_summary(found: HullDecomposition) -> str:
    """Return one line with the number of hulls, their largest error and volume."""
    return (
        f"{found.n_hulls} {'hull' if found.n_hulls == 1 else 'hulls'},"
        f" largest error {found.errors.max():.3f},"
        f" volume of hulls / volume {found.volume_ratio:.2f}"
    )


def _with_libraries(notes: Iterable[str], steps: Steps[Result]) -> Steps[Result]:
    """Load the libraries, run `steps`, and put `notes` before those of the result."""
    yield from load_libraries()
    value: Any = yield from steps
    return replace(value, notes=(*notes, *value.notes))


def summary(decomposition: Decomposition) -> str:
    """Return one line with the number of parts, psi and the mean convexity rank."""
    n_parts = decomposition.n_parts
    return (
        f"{n_parts} {'part' if n_parts == 1 else 'parts'},"
        f" psi {decomposition.psi_before:.3f} → {decomposition.psi:.3f},"
        f" mean convexity rank {decomposition.ranks.mean():.3f}"
    )
