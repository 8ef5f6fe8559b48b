"""Give one hull another shape, or remove it; the others stay."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import bpy
import numpy as np

from .... import core
from ....core.errors import DecompositionError
from ....core.geometry.frames import moved
from ....core.geometry.mesh import TriangleMesh
from ....core.parameters.hull_names import name_of_kind
from ....core.results.hulls import HullDecomposition
from ....core.steps.arrays import FloatArray
from ....core.steps.progress import Steps
from ..homes import within_parent
from ..mesh.attributes import vertex_positions
from ..read.evaluated import read_as
from ..read.shape import read_shape, scene_unit, stretch
from ..read.stretching import stretched
from ..stored.names import CORNERS_TAG, MARGIN_TAG, PIECE_TAG
from ..stored.noted_hulls import (
    forget_hulls,
    noted_hull_parameters,
    noted_hulls,
    noted_mesh_of_hulls,
)
from ..stored.record import HULLS, record_of, write_record
from ..work.computing_hulls import hulls_around
from ..work.libraries import with_libraries
from .hull_objects import erase_hulls, figures_of_hull, hull_mesh, keep_piece, tag_hull
from .listed import hulls_of, listed_hulls
from .looks import look_like, look_of

# Corners that one matrix moved are this near to where it puts them, as a share.
_SAME = 1e-4


def refit(
    obj: bpy.types.Object, name: str, shape: str, in_window: bool = False
) -> Steps[HullDecomposition]:
    """Return the steps that fit another shape to the piece that a hull is around.

    Parameters
    ----------
    obj : bpy.types.Object
    name : str
        Of a hull of the object.
    shape : str
        'HULL', 'BOX', 'CAPSULE', 'SPHERE' or 'CYLINDER'.
    in_window : bool
        Whether the steps run in a window, which must stay alive.

    Raises
    ------
    DecompositionError
        At once, if the object has no such hull or does not list it, or cannot be read.
    """
    hull = hull_called(obj, name)
    _noted_row(obj, name)
    parameters = replace(noted_hull_parameters(obj), shape=shape)
    points, has_margin = _piece_of(hull)
    if has_margin:
        parameters = replace(parameters, margin=0.0)
    points = stretched(points, stretch(obj))
    seen = read_as(noted_mesh_of_hulls(obj), obj)
    mesh, unit = seen.shape if seen else read_shape(obj), scene_unit(obj)
    assert isinstance(mesh, TriangleMesh)  # clouds have no hulls

    def work() -> Steps[HullDecomposition]:  # the core is imported by its first step
        fit = partial(core.refit_in_steps, mesh, points, parameters, scene_unit=unit)
        return (yield from hulls_around(mesh, fit, in_window))

    return with_libraries((), work())


def write_refit(
    obj: bpy.types.Object, name: str, found: HullDecomposition
) -> bpy.types.Object:
    """Give a hull of an object the shape that was found; return the hull."""
    hull, row, (shape,) = hull_called(obj, name), _noted_row(obj, name), found.shapes
    piece = _piece_of(hull)
    scale, former, look = stretch(obj), hull.data, look_of(hull)
    material = former.materials[0] if former.materials else None
    hull.data = hull_mesh(former.name, shape, scale, material)
    _bring_into(hull)
    if former.users == 0:  # else the user has linked copies of the hull
        bpy.data.meshes.remove(former)
    keep_piece(hull, *piece)
    record = record_of(obj)
    hulls = record[HULLS][HULLS]
    figures = figures_of_hull(found, 0) | {"part": hulls[row]["part"]}
    before = sum(each["volume"] for each in hulls)
    ratio = record[HULLS]["volume_ratio"]
    if ratio and np.isfinite(found.volume_ratio):
        # In the unit of the others, which may be from before Apply scaled the mesh.
        figures["volume"] = found.volume_ratio * before / ratio
    hull.name = hull.data.name = _name(obj, name, (hulls[row]["kind"], shape.kind))
    hulls[row] = {"name": hull.name, **figures}
    tag_hull(hull, figures, shape, scale)
    look_like([hull], look)
    after = sum(each["volume"] for each in hulls)
    _note(obj, record, after / before)
    return hull


def remove_hull(obj: bpy.types.Object, name: str) -> None:
    """Remove one hull of an object."""
    hull, record = hull_called(obj, name), record_of(obj)
    hulls = noted_hulls(record)
    before = sum(each["volume"] for each in hulls)
    listed = listed_hulls(obj, hulls)
    kept = [each for row, each in enumerate(hulls) if listed.get(row) != hull]
    erase_hulls(obj, [hull])
    if not kept:
        forget_hulls(obj)
        return
    record[HULLS][HULLS] = kept
    _note(obj, record, sum(each["volume"] for each in kept) / before)


def _piece_of(hull: bpy.types.Object) -> tuple[FloatArray, bool]:
    """Return the points of the piece that a hull is around, and if they have a margin.

    They are in the space of its object: the hull may have another place there, as after
    the object's transform was applied. A convex hull that was built is around its piece
    with its own vertices.
    """
    within = within_parent(hull)
    if not within.determinant():
        raise DecompositionError(f"{hull.name} has a scale of zero; change that first.")
    has_margin = PIECE_TAG not in hull or MARGIN_TAG in hull
    points = corners = vertex_positions(hull.data).astype(float)
    if PIECE_TAG in hull:
        then = np.reshape(hull.get(CORNERS_TAG, ()), (-1, 3))
        points = _moved_as(np.reshape(hull[PIECE_TAG], (-1, 3)), then, corners)
    if not (len(points) and np.isfinite(points).all()):
        raise DecompositionError(
            f"{hull.name} has no vertices, or coordinates that are no numbers; build"
            " the hulls again."
        )
    return moved(points, np.array(within)), has_margin


def _moved_as(points: FloatArray, then: FloatArray, now: FloatArray) -> FloatArray:
    """Return points, moved as one matrix moved corners, if one did."""
    if then.shape != now.shape or (then == now).all():
        return points
    before = np.c_[then, np.ones(len(then))]
    matrix = np.linalg.lstsq(before, now, rcond=None)[0]
    is_one = np.allclose(before @ matrix, now, atol=_SAME * np.ptp(now, axis=0).max())
    return np.c_[points, np.ones(len(points))] @ matrix if is_one else points


def _bring_into(hull: bpy.types.Object) -> None:
    """Bring the mesh of a hull from its object's space into the hull's own.

    The hull keeps its place, which may be animated.
    """
    within = within_parent(hull)
    hull.data.transform(within.inverted_safe())
    if within.is_negative:  # faces of a mirrored mesh point inward
        hull.data.flip_normals()


def hull_called(obj: bpy.types.Object, name: str) -> bpy.types.Object:
    """Return the hull of an object with a name; raise if it has none."""
    for hull in hulls_of(obj):
        if hull.name == name:
            return hull
    if not name:
        raise DecompositionError(f"Name a hull of {obj.name}: `hull` is empty.")
    raise DecompositionError(
        f"{obj.name} has no hull {name}; choose one in the list of its hulls."
    )


def _noted_row(obj: bpy.types.Object, name: str) -> int:
    """Return the row of a hull among those that are noted; raise if it is not there."""
    for row, hull in listed_hulls(obj, noted_hulls(record_of(obj))).items():
        if hull.name == name:
            return row
    raise DecompositionError(
        f"{name} is not in the list of {obj.name}'s hulls, as a copy is not; choose one"
        " that is, or build the hulls again."
    )


def _note(obj: bpy.types.Object, record: dict[str, Any], growth: float) -> None:
    """Note changed hulls, whose volumes together have grown by a factor."""
    noted = record[HULLS]
    noted["largest_error"] = max(each["error"] for each in noted[HULLS])
    if noted["volume_ratio"] is not None:
        noted["volume_ratio"] *= growth
    write_record(obj, record)


def _name(obj: bpy.types.Object, former: str, kinds: tuple[str, str]) -> str:
    """Return the name of a hull of a new kind: with Unreal's naming, that is in it."""
    parameters = noted_hull_parameters(obj)
    naming = parameters.naming, parameters.template
    name = name_of_kind(*naming, obj.name, former, kinds)
    return former if bpy.data.objects.get((name, None)) else name
