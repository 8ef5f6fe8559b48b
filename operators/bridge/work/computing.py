"""What is computed of an object: checked and read at once, done step by step."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING, TypeVar

import bpy
import numpy as np

from ....core.errors import DecompositionError
from ....core.parameters.hulls import HullParameters
from ....core.parameters.parts import Parameters
from ....core.steps.progress import Progress, Steps, within
from ..mesh.selection import selected_faces
from ..parts.palette import part_srgb
from ..parts.parted import part_identities, part_labels
from ..parts.write import check_writable
from ..rays.bvh import BvhRayCaster
from ..read.shape import read_shape, reading_notes
from ..refusals import CONVERTIBLE, hull_refusal
from ..stored.record import check_records, noted_parameters
from .sight_cache import is_seen, see_once

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ....core.decomposition import Measurement
    from ....core.hulls.build import HullDecomposition
    from ....core.parts.find import Decomposition
    from ....core.pictures import Picture
    from ....core.sight.point_view import PointViewer
    from ....core.sight.prepared import Shape

    Result = TypeVar(
        "Result", Decomposition, Measurement, HullDecomposition, PointViewer, Picture
    )

# In the order in which they load each other.
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
    """Check and read an object that is to be written to; return the work to be done.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to.
    """
    if obj.type not in CONVERTIBLE:  # else parts go to a new object
        check_writable(obj)
    mesh = read_shape(obj)

    return _prepared(reading_notes(obj), _decompose(mesh, parameters))


def is_quick(obj: bpy.types.Object, parameters: Parameters) -> bool:
    """Return whether `decompose_object` needs no new lines of sight.

    Errors are those of `decompose_object`.
    """
    check_writable(obj)
    return parameters.levels == 1 and is_seen(read_shape(obj), parameters)


def _decompose(shape: Shape, parameters: Parameters) -> Steps[Decomposition]:
    """Decompose as `core.decomposition.decompose` does, by the latest visibility."""
    from ....core.decomposition import decompose_seen, share_of_sight

    share = share_of_sight(parameters)
    visibility = yield from within(see_once(shape, parameters), 0.0, share)
    steps = decompose_seen(shape, visibility, parameters, BvhRayCaster)
    return (yield from within(steps, share, 1.0))


def measure_object(obj: bpy.types.Object, parameters: Parameters) -> Steps[Measurement]:
    """Check and read an object; return the work to be done.

    Errors are those of `decompose_object`.
    """
    check_records(obj)
    mesh = read_shape(obj)

    def work() -> Steps[Measurement]:
        from ....core.decomposition import measure

        return (yield from measure(mesh, parameters, BvhRayCaster))

    return _prepared(reading_notes(obj), work())


def point_viewer_of(
    obj: bpy.types.Object, parameters: Parameters
) -> Steps[PointViewer]:
    """Check and read an object; return the work of making it ready to be looked from.

    Errors are those of `decompose_object`.
    """
    shape = read_shape(obj)

    def work() -> Steps[PointViewer]:
        from ....core.sight.point_view import make_point_viewer

        return (yield from make_point_viewer(shape, parameters, BvhRayCaster))

    return _prepared(reading_notes(obj), work())


def measure_selection_of(
    obj: bpy.types.Object, parameters: Parameters
) -> Steps[Measurement]:
    """Check and read an object; return the work of measuring its selected faces.

    Errors are those of `decompose_object`, and that no face is selected.
    """
    check_records(obj)
    mesh, faces = read_shape(obj), selected_faces(obj)
    if not faces.any():
        raise DecompositionError(
            "No faces are selected; select those to be measured in Edit Mode."
        )

    def work() -> Steps[Measurement]:
        from ....core.measurement import measure_region

        return (yield from measure_region(mesh, faces, parameters, BvhRayCaster))

    return _prepared(reading_notes(obj), work())


def picture_of(obj: bpy.types.Object, kind: str) -> Steps[Picture]:
    """Check and read an object with parts; return the work of drawing a picture of it.

    Lines of sight are looked up as they were for the parts. Errors are those of
    `decompose_object`.
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
        from ....core.pictures import draw_picture

        visibility = yield from within(see_once(shape, parameters), 0.0, 0.9)
        yield Progress("Picture", 0.9)
        return draw_picture(kind, visibility, labels, parameters, colors)

    return _prepared((), work())


def build_hulls_of(
    obj: bpy.types.Object, parameters: Parameters, hull_parameters: HullParameters
) -> Steps[HullDecomposition]:
    """Check and read an object; return the work of building hulls around its parts.

    An object without parts is decomposed only where each is to get one shape, and they
    are not written to it. Errors are those of `decompose_object`.
    """
    reason = hull_refusal(obj)
    if reason:
        raise DecompositionError(f"{reason}.")
    check_records(obj)
    mesh, labels = read_shape(obj), part_labels(obj)

    def work() -> Steps[HullDecomposition]:
        from ....core.hulls.build import build_hulls

        found, start = labels, 0.0
        if found is None and hull_parameters.pieces == "PARTS":
            start = 0.4
            parts = yield from within(_decompose(mesh, parameters), 0, start)
            found = parts.labels
        steps = build_hulls(mesh, found, hull_parameters, parameters.seed)
        return (yield from within(steps, start, 1.0))

    return _prepared(reading_notes(obj), work())


def load_libraries() -> Steps[None]:
    """Load what the core needs: a second that enabling the add-on must not take.

    Once in a session, and one library after the other, so that a window stays alive.
    """
    for name in _LIBRARIES:
        if name not in sys.modules:
            yield Progress("Libraries", 0.0)
            import_module(name)


def hull_summary(found: HullDecomposition) -> str:
    """Return the figures of a hull decomposition in a line."""
    return (
        f"{found.n_hulls} {'hull' if found.n_hulls == 1 else 'hulls'},"
        f" largest error {found.errors.max():.3f},"
        f" volume of hulls / volume {found.volume_ratio:.2f}"
    )


def _prepared(notes: Iterable[str], steps: Steps[Result]) -> Steps[Result]:
    """Load what `steps` need, run them and put `notes` before those of their value."""
    yield from load_libraries()
    value = yield from steps
    return replace(value, notes=(*notes, *value.notes))


def summary(decomposition: Decomposition) -> str:
    """Return the figures of a decomposition in a line."""
    n_parts = decomposition.n_parts
    return (
        f"{n_parts} {'part' if n_parts == 1 else 'parts'},"
        f" psi {decomposition.psi_before:.3f} → {decomposition.psi:.3f},"
        f" mean convexity rank {decomposition.ranks.mean():.3f}"
    )
