"""Build collision shapes: cut a solid into pieces, join some, fit a shape to each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..cache import ShapeCache
from ..errors import DecompositionError
from ..geometry.array_checks import check_types
from ..geometry.mesh import TriangleMesh
from ..geometry.primitives import CollisionShape, Hull
from ..geometry.shape import Shape, checked_labels
from ..parameters.hulls import HullParameters
from ..parameters.parameter import check, field_of
from ..parameters.parts import Parameters
from ..results.hulls import HullDecomposition
from ..sight.prepared import PreparedShape
from ..steps.arrays import FloatArray, IntArray
from ..steps.memo import digest
from ..steps.progress import Progress, Steps, within
from .convex_solid import exact_error, hull_of_convex
from .cutting.cell import whole
from .cutting.starts import pieces_of
from .fitting import Fit, fit_for
from .joining import join_pieces
from .notes import notes_on, notes_on_parts
from .piece import Piece, piece_of_part
from .solid import Solid, solid_of


def build_hulls_in_steps(
    shape: Shape,
    parameters: HullParameters,
    cache: ShapeCache,
    labels: IntArray | None = None,
    seed: int = 0,
    scene_unit: float = 1.0,
    kinds: Mapping[int, str] | None = None,
) -> Steps[HullDecomposition]:
    """Put convex collision shapes around a mesh.

    Parameters
    ----------
    shape : TriangleMesh
    parameters : HullParameters
    cache : ShapeCache
    labels : (P,) int, optional
        Part of each polygon, from 0. ``pieces="PARTS"`` needs it: each is one piece.
    seed : int
        Seed of the random surface samples, from 0.
    scene_unit : float
        Length in the scene of 1 in the units of the mesh.
    kinds : mapping of int to str, optional
        Kind of shape of single parts; `parameters.shape` is that of the others.

    Returns
    -------
    Steps of HullDecomposition

    Raises
    ------
    TypeError
        If an argument has a wrong type.
    DecompositionError
        If the shape cannot be normalized or is a point cloud, or labels do not fit it.
    """
    check_types(
        shape=(shape, Shape),
        parameters=(parameters, HullParameters),
        cache=(cache, ShapeCache),
        kinds=(kinds or {}, Mapping),
    )
    check(field_of(Parameters, "seed"), seed)
    if not isinstance(shape, TriangleMesh):
        raise DecompositionError("A cloud has no faces; give it a surface for hulls.")
    labels = checked_labels(labels, shape, needed=parameters.pieces == "PARTS")
    rows = None if labels is None else digest(labels)
    key = "hulls", parameters, rows, seed, scene_unit, frozenset((kinds or {}).items())
    steps = partial(_build, shape, parameters, cache, labels, seed, scene_unit, kinds)
    return (yield from cache.recall(shape, key, steps))


def _build(
    shape: TriangleMesh,
    parameters: HullParameters,
    cache: ShapeCache,
    labels: IntArray | None,
    seed: int,
    scene_unit: float,
    kinds: Mapping[int, str] | None,
) -> Steps[HullDecomposition]:
    """Put shapes around a mesh that is not known yet."""
    prepared = yield from within(cache.prepare(shape), 0.0, 0.0)
    numbers, parts = _parts_of_triangles(prepared.solid, labels)
    fit, factor = fit_for(shape, parameters, scene_unit, numbers.tolist(), kinds)
    found = yield from _find(prepared, fit, shape.diagonal / fit.unit, parts, seed)
    errors = found.errors * factor
    notes = notes_on_parts(len(numbers), len(found.shapes), fit)
    return HullDecomposition(
        tuple(each.moved(fit.unit, shape.center) for each in found.shapes),
        errors,
        numbers[found.rows],
        found.volume_ratio,
        (*prepared.notes, *notes, *notes_on(found.shapes, found.hulls, errors, fit)),
        parameters.error_unit,
        fit.unit * scene_unit,
    )


@dataclass(frozen=True, eq=False)
class _Found:
    """Shapes where the longest side of the whole is 2, and what they are around.

    Attributes
    ----------
    shapes : sequence of CollisionShape
    errors : (K,) float
    hulls : sequence of Hull
        Convex hulls of the pieces.
    rows : (K,) int
        Row of the part that each belongs to.
    volume : float
        Volume of the solid.
    """

    shapes: Sequence[CollisionShape]
    errors: FloatArray
    hulls: Sequence[Hull]
    rows: IntArray
    volume: float

    @property
    def volume_ratio(self) -> float:
        """Volume of all shapes over that of the solid; `inf` if it is flat."""
        total = sum(shape.volume for shape in self.shapes)
        return total / self.volume if self.volume > 0 else np.inf


def _find(
    prepared: PreparedShape, fit: Fit, scale: float, parts: IntArray, seed: int
) -> Steps[_Found]:
    """Return the shapes around a mesh; `scale` makes its longest side 2."""
    found = None
    if prepared.convex and not parts.any():
        found = _around_convex(prepared, fit, scale)
    if found is None:
        yield Progress("Solid", 0.0)
        solid = yield from within(solid_of(prepared.solid, seed, scale), 0.0, 0.0)
        found = yield from _around_pieces(solid, parts, fit)
    return found


def _around_convex(prepared: PreparedShape, fit: Fit, scale: float) -> _Found | None:
    """Return the shape around a convex solid, None if it must be cut or measured."""
    hull = hull_of_convex(prepared, scale)
    shape = fit.of_part(0).shape(hull)
    error = exact_error(shape, hull, fit)
    by_error = fit.parameters.pieces != "PARTS"
    if error is None or (by_error and error > fit.max_error):
        return None
    errors, row = np.array([error]), np.zeros(1, dtype=np.int64)
    return _Found([shape], errors, [hull], row, hull.volume)


def _around_pieces(solid: Solid, parts: IntArray, fit: Fit) -> Steps[_Found]:
    """Cut a solid, or take its parts, and return a shape around each piece."""
    pieces = yield from within(_pieces_of(solid, parts, fit), 0.0, 0.95)
    errors, rows, shapes = [], [], []
    for turn, piece in enumerate(pieces):
        progress = Progress("Measuring", 0.95 + 0.05 * turn / len(pieces))
        yield progress
        has_own = fit.parameters.pieces == "PARTS" or piece.fit == fit
        final = piece if has_own else replace(piece, fit=fit)
        shapes.append(final.shape)
        yield progress
        errors.append(final.bound.value)
        yield progress
        is_part = piece.part >= 0
        rows.append(piece.part if is_part else solid.main_part(parts, piece.hull))
    order = sorted(range(len(pieces)), key=lambda k: -round(shapes[k].volume, 6))
    return _Found(
        [shapes[k] for k in order],
        np.array(errors)[order],
        [pieces[k].hull for k in order],
        np.array(rows)[order],
        solid.true_volume,
    )


def _pieces_of(solid: Solid, parts: IntArray, fit: Fit) -> Steps[list[Piece]]:
    """Return the pieces that get a shape each."""
    most = fit.parameters.max_hulls
    if fit.parameters.pieces == "PARTS":
        start = []
        for row in np.unique(parts).tolist():
            yield Progress("Solid", 0.0)
            start.append(piece_of_part(solid, fit.of_part(row), parts, row))
        return (yield from join_pieces(start, most, {}, close=False))
    cell = whole(solid, fit)
    if not fit.has_room(cell.hull):  # cuts cannot make up for the margin
        no_margin = replace(fit.parameters, margin=0.0)
        cell = replace(cell, fit=replace(fit, parameters=no_margin))
    return (yield from pieces_of(cell, most))


def _parts_of_triangles(
    mesh: TriangleMesh, labels: IntArray | None
) -> tuple[IntArray, IntArray]:
    """Return the numbers of the parts, (K,), and the row of each triangle's, (T,).

    Without labels, all triangles are in one part of number −1.
    """
    if labels is None:
        return np.array([-1]), np.zeros(len(mesh.triangles), dtype=np.int64)
    return np.unique(labels[mesh.polygons], return_inverse=True)
