"""The public functions: a shape and settings in, the finished result out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any, TypeVar

from numpy.typing import ArrayLike

from .. import core
from ..core.parameters.hulls import HullParameters
from ..core.parameters.parts import Parameters
from ..core.results import Decomposition, HullDecomposition, Measurement
from ..core.steps.progress import Progress, Steps, mapped, run
from .bridge.rays.choice import choose_ray_caster
from .bridge.read.arrays import labels_of, mesh_of, shape_of

T = TypeVar("T")
Settings = TypeVar("Settings", Parameters, HullParameters)
ShowProgress = Callable[[str, float], None]


def decompose(
    shape: object,
    faces: object = None,
    *,
    parameters: Parameters | None = None,
    progress: ShowProgress | None = None,
    **changes: Any,
) -> Decomposition:
    """Split a shape into weakly convex parts.

    Parameters
    ----------
    shape : object
        Vertices, (V, 3) float, in any unit; a `TriangleMesh`; a `PointCloud`; a
        Blender object, read without its modifiers; or anything with `vertices` and
        `faces`, such as a `trimesh.Trimesh`.
    faces : (F, 3) int or sequence of sequences of int, optional
        Rows of the vertices around each triangle, or polygon of any number of
        corners, counter-clockwise from outside. Vertices without faces are points.
    parameters : Parameters, optional
        The settings; all at their defaults if None.
    progress : callable, optional
        Called as ``progress(stage, fraction)`` now and then; fraction rises to 1.
    **changes
        Fields of `Parameters` with another value than in `parameters`.

    Returns
    -------
    Decomposition
        Its `labels`, (F,) int, are the part of each row of `faces`, or of each point.

    Raises
    ------
    TypeError
        If an argument is of another type, or a keyword names no parameter.
    DecompositionError
        If the shape or a parameter makes no sense, or no ray caster is installed.

    References
    ----------
    Asafi, Goren, Cohen-Or, "Weak Convex Decomposition by Lines-of-sight", 2013:
    samples are embedded by eq. 3, parts are compared by psi, eq. 5.

    Examples
    --------
    An L in one hexagon below, one above and six walls:

    >>> from weak_convex_decomposition import decompose
    >>> outline = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)]
    >>> vertices = [(x, y, z) for z in (0, 1) for x, y in outline]
    >>> walls = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
    >>> faces = [(5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *walls]
    >>> decompose(vertices, faces, samples=400).n_parts
    2
    """
    settings = _settings("decompose", parameters, Parameters, changes)
    cache = core.ShapeCache(choose_ray_caster())
    steps = core.decompose_in_steps(shape_of(shape, faces), settings, cache)
    return _finish(steps, progress)


def measure(
    shape: object,
    faces: object = None,
    *,
    parameters: Parameters | None = None,
    progress: ShowProgress | None = None,
    **changes: Any,
) -> Measurement:
    """Estimate the convexity rank of a shape: how far it sees itself.

    Parameters
    ----------
    shape : object
        Vertices, (V, 3) float, in any unit; a `TriangleMesh`; a `PointCloud`; a
        Blender object, read without its modifiers; or anything with `vertices` and
        `faces`, such as a `trimesh.Trimesh`.
    faces : (F, 3) int or sequence of sequences of int, optional
        Rows of the vertices around each triangle, or polygon of any number of
        corners, counter-clockwise from outside. Vertices without faces are points.
    parameters : Parameters, optional
        The settings; only those of samples and lines of sight matter.
    progress : callable, optional
        Called as ``progress(stage, fraction)`` now and then; fraction rises to 1.
    **changes
        Fields of `Parameters` with another value than in `parameters`.

    Returns
    -------
    Measurement
        Its `rank` is the share of pairs of points of the surface that see each other
        through the inside: 1 for a convex shape, less for others.

    Raises
    ------
    TypeError
        If an argument is of another type, or a keyword names no parameter.
    DecompositionError
        If the shape or a parameter makes no sense, or no ray caster is installed.

    References
    ----------
    Asafi, Goren, Cohen-Or, "Weak Convex Decomposition by Lines-of-sight", 2013: eq. 1.

    Examples
    --------
    A tetrahedron is convex:

    >>> from weak_convex_decomposition import measure
    >>> vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> round(measure(vertices, faces, samples=400).rank, 2)
    1.0
    """
    settings = _settings("measure", parameters, Parameters, changes)
    cache = core.ShapeCache(choose_ray_caster())
    steps = core.measure_in_steps(shape_of(shape, faces), settings, cache)
    return _finish(steps, progress)


def build_hulls(
    mesh: object,
    /,
    faces: object = None,
    *,
    labels: ArrayLike | None = None,
    parameters: HullParameters | None = None,
    progress: ShowProgress | None = None,
    **changes: Any,
) -> HullDecomposition:
    """Put convex collision shapes around a mesh.

    Parameters
    ----------
    mesh : object
        Vertices, (V, 3) float, in any unit; a `TriangleMesh`; a Blender object with a
        mesh, read without its modifiers; or anything with `vertices` and `faces`,
        such as a `trimesh.Trimesh`.
    faces : (F, 3) int or sequence of sequences of int, optional
        Rows of the vertices around each triangle, or polygon of any number of
        corners, counter-clockwise from outside.
    labels : (F,) int, optional
        Part of each row of `faces`, from 0, as `decompose` finds them. Tells the part
        that each hull is of; ``pieces="PARTS"`` needs it.
    parameters : HullParameters, optional
        The settings; all at their defaults if None.
    progress : callable, optional
        Called as ``progress(stage, fraction)`` now and then; fraction rises to 1.
    **changes
        Fields of `HullParameters` with another value than in `parameters`.

    Returns
    -------
    HullDecomposition
        Its `shapes` are in the unit of the vertices, the largest first.

    Raises
    ------
    TypeError
        If an argument is of another type, or a keyword names no parameter.
    DecompositionError
        If the mesh, the labels or a parameter make no sense.

    References
    ----------
    Wei, Liu, Ling, Su, "Approximate Convex Decomposition for 3D Meshes with
    Collision-Aware Concavity and Tree Search", 2022: `errors`.

    Examples
    --------
    An L in two boxes:

    >>> from weak_convex_decomposition import build_hulls
    >>> outline = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)]
    >>> vertices = [(x, y, z) for z in (0, 1) for x, y in outline]
    >>> walls = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
    >>> faces = [(5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *walls]
    >>> build_hulls(vertices, faces, shape="BOX").n_hulls
    2
    """
    settings = _settings("build_hulls", parameters, HullParameters, changes)
    solid = mesh_of(mesh, faces)
    parts = labels_of(labels, solid, needed=settings.pieces == "PARTS")
    cache = core.ShapeCache(choose_ray_caster())
    steps = core.build_hulls_in_steps(solid, settings, cache, parts)
    return _finish(steps, progress)


def _settings(
    function: str,
    parameters: Settings | None,
    kind: type[Settings],
    changes: dict[str, Any],
) -> Settings:
    """Return the settings with some of them changed, or raise if they are none."""
    if parameters is not None and not isinstance(parameters, kind):
        raise TypeError(
            f"`parameters` must be {kind.__name__}, not {type(parameters).__name__}."
        )
    names = [field.name for field in fields(kind)]
    for name in changes.keys() - set(names):
        raise TypeError(
            f"{function}() got an unexpected keyword argument {name!r}; its"
            f" parameters are {', '.join(names)}."
        )
    return replace(parameters or kind(), **changes)


def _finish(steps: Steps[T], progress: ShowProgress | None) -> T:
    """Run `steps` to their end and tell `progress` how far they are."""
    if progress is None:
        return run(steps)

    def tell(now: Progress) -> Progress:
        progress(now.stage, float(now.fraction))
        return now

    found = run(mapped(steps, tell))
    progress("Done", 1.0)
    return found
