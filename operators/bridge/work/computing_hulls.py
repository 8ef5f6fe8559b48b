"""Build hulls around an object, here or in another process.

Single steps on a large mesh take longer than a window may stand still, so those are
done in another process. It takes a second to start: hulls of small meshes are built
here.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import bpy
import numpy as np

from .... import core
from ....core.errors import DecompositionError
from ....core.geometry.mesh import TriangleMesh
from ....core.geometry.shape import Shape
from ....core.parameters.hulls import HullParameters
from ....core.parameters.parts import Parameters
from ....core.results.hulls import HullDecomposition
from ....core.steps.arrays import IntArray
from ....core.steps.processes import Processes
from ....core.steps.progress import Steps, run, within
from ..parts.read import part_labels
from ..parts.rows import hull_shapes
from ..read.evaluated import SeenMesh
from ..read.shape import scene_unit
from ..refusals import hull_refusal
from ..stored.record import check_records
from .computing import read_seen
from .libraries import with_libraries
from .session_cache import session_cache

# With more triangles, single steps may take over 0.1 s.
_MANY = 10_000


def build_hulls_of(
    obj: bpy.types.Object,
    parameters: Parameters,
    hull_parameters: HullParameters,
    seen: SeenMesh | None = None,
    processes: Processes | None = None,
    in_window: bool = False,
) -> Steps[HullDecomposition]:
    """Return the steps that build hulls around an object or its parts.

    An object without parts is first decomposed if each part is to get one shape. It
    does not get these parts, and hulls do not belong to them.

    Parameters
    ----------
    obj : bpy.types.Object
    parameters : Parameters
        Used to decompose the object.
    hull_parameters : HullParameters
    seen : SeenMesh, optional
        The mesh as it is seen, to be used in place of the object's own.
    processes : Processes, optional
        Where hulls are built at once, if no parts have to be found for them.
    in_window : bool
        Whether the steps run in a window, which must stay alive.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or can have no hulls.
    """
    if reason := hull_refusal(obj):
        raise DecompositionError(f"{reason}.")
    check_records(obj)
    notes, read = read_seen(obj, seen, for_parts=False)
    labels = _labels_of(obj, seen)
    build = _builder(obj, labels, hull_parameters, parameters.seed)
    if labels is None and hull_parameters.pieces == "PARTS":
        steps = _with_new_parts(read, parameters, build, in_window)
    elif processes:
        elsewhere = partial(build, run(read), cache=core.ShapeCache(core.no_rays))
        steps = processes.steps("Cutting", elsewhere)
    else:
        steps = _without_new_parts(read, build, in_window)
    size = 1.0 if hull_parameters.error_unit == "SCENE" else scene_unit(obj)
    return with_libraries(notes, _enlarged(steps, size))


def _labels_of(obj: bpy.types.Object, seen: SeenMesh | None) -> IntArray | None:
    """Return the part of each face that is read, None if there are no parts."""
    labels = part_labels(obj)
    if seen is None or labels is None:
        return labels
    return labels[seen.origins] if seen.corresponds else None


def _builder(
    obj: bpy.types.Object,
    labels: IntArray | None,
    parameters: HullParameters,
    seed: int,
) -> Callable[..., Steps[HullDecomposition]]:
    """Return what takes the shape of an object and a `cache`, and builds its hulls."""
    # Relative errors do not depend on an object's size: so, equal meshes stay equal.
    unit = scene_unit(obj) if parameters.error_unit == "SCENE" else 1.0
    return partial(
        core.build_hulls_in_steps,
        parameters=parameters,
        labels=labels,
        seed=seed,
        scene_unit=unit,
        kinds=hull_shapes(obj) if labels is not None else {},
    )


def _with_new_parts(
    read: Steps[Shape],
    parameters: Parameters,
    build: Callable[..., Steps[HullDecomposition]],
    in_window: bool,
) -> Steps[HullDecomposition]:
    """Find parts of a shape, and build their hulls; the object does not get them."""
    shape = yield from read
    finding = core.decompose_in_steps(shape, parameters, session_cache())
    labels = (yield from within(finding, 0.0, 0.4)).labels
    building = hulls_around(shape, partial(build, shape, labels=labels), in_window)
    found = yield from within(building, 0.4, 1.0)
    return replace(found, parts=np.full_like(found.parts, -1))


def _without_new_parts(
    read: Steps[Shape],
    build: Callable[..., Steps[HullDecomposition]],
    in_window: bool,
) -> Steps[HullDecomposition]:
    """Build hulls of a shape, or of the parts that it has."""
    shape = yield from read
    return (yield from hulls_around(shape, partial(build, shape), in_window))


def hulls_around(
    shape: Shape, compute: Callable[..., Steps[HullDecomposition]], in_window: bool
) -> Steps[HullDecomposition]:
    """Return the steps that build hulls around a shape, here or in another process.

    Parameters
    ----------
    shape : Shape
    compute : callable
        Takes the argument `cache`, and returns steps. Can be pickled.
    in_window : bool
        Whether the steps run in a window, which must stay alive.
    """
    is_large = isinstance(shape, TriangleMesh) and len(shape.triangles) > _MANY
    if not (in_window and is_large):
        return (yield from compute(cache=session_cache()))
    elsewhere = partial(compute, cache=core.ShapeCache(core.no_rays))
    apart = Processes(1)
    try:
        return (yield from apart.steps("Solid", elsewhere))
    finally:
        apart.close()


def _enlarged(
    steps: Steps[HullDecomposition], factor: float
) -> Steps[HullDecomposition]:
    """Return the steps that end in hulls of an object that is larger by a factor."""
    found = yield from steps
    return replace(found, half_side=found.half_side * factor)


def hull_summary(found: HullDecomposition) -> str:
    """Return one line with the number of hulls, their largest error and volume."""
    unit = " in the scene" if found.error_unit == "SCENE" else ""
    ratio, volume = found.volume_ratio, "no volume inside"
    if math.isfinite(ratio):
        volume = f"volume of hulls / volume {ratio:.2f}"
    return (
        f"{found.n_hulls} {'hull' if found.n_hulls == 1 else 'hulls'},"
        f" largest error {found.errors.max():.3g}{unit}, {volume}"
    )
