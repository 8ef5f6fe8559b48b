"""The public functions of the package: `decompose`, `measure` and `build_hulls`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from typing import Any, TypeVar

from numpy.typing import ArrayLike

from .. import core
from ..core.errors import DecompositionError
from ..core.geometry.array_checks import check_types, described
from ..core.geometry.shape import checked_labels
from ..core.parameters.hulls import HullParameters
from ..core.parameters.parts import Parameters
from ..core.results.hulls import HullDecomposition
from ..core.results.parts import Decomposition, Measurement
from ..core.steps.arrays import IntArray
from ..core.steps.progress import Steps, T, run
from .bridge.rays.choice import choose_ray_caster
from .bridge.read.arrays import mesh_of, scene_unit_of, shape_of

Settings = TypeVar("Settings", Parameters, HullParameters)
ShowProgress = Callable[[str, float], None]


def decompose(
    shape: object,
    faces: object = None,
    *,
    parameters: Parameters | None = None,
    progress: ShowProgress | None = None,
    caster: str | None = None,
    **changes: Any,
) -> Decomposition:
    """Split a shape into weakly convex parts.

    Parameters
    ----------
    shape : (V, 3) float, TriangleMesh, PointCloud, bpy.types.Object or trimesh.Trimesh
        Or any object with `vertices` and `faces`. Modifiers of an object are ignored.
    faces : (F, 3) int or sequence of sequences of int, optional
        Vertex rows of each face, counter-clockwise from outside; None for points.
    parameters : Parameters, default ``Parameters()``
    progress : callable, called as ``progress(stage, fraction)``, optional
    caster : 'BLENDER' or 'EMBREE', default the first of them that is installed
    **changes : values of fields of `Parameters`, such as ``parts=5``

    Returns
    -------
    Decomposition
        Its `labels`, (F,) int, are the parts of the faces or points. Uses eq. 3 and 5.

    Raises
    ------
    TypeError
        If a keyword is no field of `Parameters`, or another argument has a wrong type.
    DecompositionError
        If the shape, the value of a field or its type, or the ray caster is refused.

    References
    ----------
    Asafi, Goren, Cohen-Or 2013, "Weak Convex Decomposition by Lines-of-sight".

    Examples
    --------
    >>> from weak_convex_decomposition import decompose
    >>> vertices = [(*p, z) for z in (0, 1) for p in [(0, 0), (5, 0), (1, 1), (0, 5)]]
    >>> walls = [(i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4) for i in range(4)]
    >>> decompose(vertices, [(3, 2, 1, 0), (4, 5, 6, 7), *walls], samples=400).n_parts
    2
    """
    settings = _keeping(_settings("decompose", parameters, Parameters, changes))
    cache = core.ShapeCache(choose_ray_caster(caster))
    steps = core.decompose_in_steps(shape_of(shape, faces), settings, cache)
    return _finish(steps, progress)


def measure(
    shape: object,
    faces: object = None,
    *,
    parameters: Parameters | None = None,
    progress: ShowProgress | None = None,
    caster: str | None = None,
    **changes: Any,
) -> Measurement:
    """Estimate the convexity rank of a shape: the share of pairs that see each other.

    Parameters
    ----------
    shape : (V, 3) float, TriangleMesh, PointCloud, bpy.types.Object or trimesh.Trimesh
        Or any object with `vertices` and `faces`. Modifiers of an object are ignored.
    faces : (F, 3) int or sequence of sequences of int, optional
        Vertex rows of each face, counter-clockwise from outside; None for points.
    parameters : Parameters, default ``Parameters()``
    progress : callable, called as ``progress(stage, fraction)``, optional
    caster : 'BLENDER' or 'EMBREE', default the first of them that is installed
    **changes : values of fields of `Parameters`, such as ``samples=800``

    Returns
    -------
    Measurement
        Its `rank` is 1 for a convex shape, and less for others.

    Raises
    ------
    TypeError
        If a keyword is no field of `Parameters`, or another argument has a wrong type.
    DecompositionError
        If the shape, the value of a field or its type, or the ray caster is refused.

    References
    ----------
    Asafi, Goren, Cohen-Or 2013, "Weak Convex Decomposition by Lines-of-sight", eq. 1.

    Examples
    --------
    >>> from weak_convex_decomposition import measure
    >>> vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> round(measure(vertices, faces, samples=400).rank, 2)
    1.0
    """
    settings = _settings("measure", parameters, Parameters, changes)
    cache = core.ShapeCache(choose_ray_caster(caster))
    steps = core.measure_in_steps(shape_of(shape, faces), settings, cache)
    return _finish(steps, progress)


def build_hulls(
    mesh: object,
    /,
    faces: object = None,
    *,
    labels: ArrayLike | None = None,
    part_shapes: Mapping[int, str] | None = None,
    parameters: HullParameters | None = None,
    progress: ShowProgress | None = None,
    **changes: Any,
) -> HullDecomposition:
    """Put convex collision shapes around a mesh.

    Parameters
    ----------
    mesh : (V, 3) float, TriangleMesh, bpy.types.Object, or with `vertices` and `faces`
    faces : (F, 3) int or lists of vertex rows, counter-clockwise from outside, optional
    labels : (F,) int, the part of each face, from 0; ``pieces="PARTS"`` needs it
    part_shapes : mapping of int to str, shapes of single parts: ``{0: "SPHERE"}``
    parameters : HullParameters, default ``HullParameters()``
    progress : callable, called as ``progress(stage, fraction)``, optional
    **changes : values of fields of `HullParameters`, such as ``shape="BOX"``

    Returns
    -------
    HullDecomposition: `shapes`, largest first, in units of the vertices; see `stretch`

    Raises
    ------
    TypeError, DecompositionError
        If an argument has a wrong type, or a value that makes no sense.

    References
    ----------
    Wei, Liu, Ling, Su 2022, CoACD, section 4: the `errors` of the hulls.

    Examples
    --------
    >>> from weak_convex_decomposition import build_hulls
    >>> faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> build_hulls([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], faces).n_hulls
    1
    """
    settings = _settings("build_hulls", parameters, HullParameters, changes)
    solid = mesh_of(mesh, faces)
    parts = checked_labels(labels, solid, needed=settings.pieces == "PARTS")
    cache = core.ShapeCache(choose_ray_caster())
    unit, kinds = scene_unit_of(mesh), _kinds(part_shapes, parts, settings)
    steps = core.build_hulls_in_steps(solid, settings, cache, parts, 0, unit, kinds)
    return _finish(steps, progress)


def _keeping(settings: Parameters) -> Parameters:
    """Raise if faces are to be cut: the result has one label for each face given."""
    if settings.seams == "CUT":
        raise DecompositionError(
            "decompose() returns the parts of the faces as they are; to cut faces, use"
            " bpy.ops.wcd.decompose(seams='CUT') or the command line."
        )
    return settings


def _kinds(
    part_shapes: Mapping[int, str] | None,
    labels: IntArray | None,
    settings: HullParameters,
) -> dict[int, str]:
    """Return the shapes of single parts, after checking them."""
    kinds = {} if part_shapes is None else part_shapes
    check_types(part_shapes=(kinds, Mapping))
    for kind in kinds.values():
        replace(settings, shape=kind)  # raises if it is none
    known = set(() if labels is None else labels.tolist())
    unknown = [part for part in kinds if part not in known]
    if kinds and (settings.pieces != "PARTS" or unknown):
        raise DecompositionError(
            f"`part_shapes` names part {unknown[0]!r}, which no face has; see `labels`."
            if unknown
            else 'Shapes of single parts need Pieces = PARTS; pass pieces="PARTS".'
        )
    return dict(kinds)


def _settings(
    function: str,
    parameters: Settings | None,
    kind: type[Settings],
    changes: dict[str, Any],
) -> Settings:
    """Return `parameters` with the fields in `changes` replaced; TypeError if wrong."""
    parameters = kind() if parameters is None else parameters
    check_types(parameters=(parameters, kind))
    names = [field.name for field in fields(kind)]
    for name in changes.keys() - set(names):
        raise TypeError(
            f"{function}() got an unexpected keyword argument {name!r}; its"
            f" parameters are {', '.join(names)}."
        )
    return replace(parameters, **changes)


def _finish(steps: Steps[T], progress: ShowProgress | None) -> T:
    """Run `steps` to their end and report their progress to the callable `progress`."""
    if progress is None:
        return run(steps)
    if not callable(progress):
        raise TypeError(
            "`progress` must be a function of stage and fraction, not"
            f" {described(progress)}."
        )
    found = run(steps, lambda now: progress(now.stage, float(now.fraction)))
    progress("Done", 1.0)
    return found
