"""Build collision shapes: cut a solid into pieces, join some, fit a shape to each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..cache import ShapeCache
from ..errors import DecompositionError
from ..geometry.mesh import TriangleMesh
from ..geometry.primitives import CollisionShape
from ..geometry.shape import Shape
from ..parameters.hulls import HullParameters
from ..results import HullDecomposition
from ..sight.prepared import PreparedShape
from ..steps.progress import Progress, Steps, within
from .best_cut import best_cut
from .convex_hull import offset
from .fitting import fit_shape
from .joining import join_pieces
from .piece import Cell, Piece, piece_of_part, whole
from .solid import Solid, solid_of

# Number of pieces to cut, as a multiple of the number of hulls allowed. Each cut is
# the best one only at its turn; joining the surplus pieces corrects that.
_SURPLUS = 2.0


def build_hulls_in_steps(
    shape: Shape,
    parameters: HullParameters,
    cache: ShapeCache,
    labels: NDArray[np.int64] | None = None,
    seed: int = 0,
) -> Steps[HullDecomposition]:
    """Put convex collision shapes around a mesh.

    The error of a hull is CoACD's concavity (Wei et al. 2022), see `Piece.error`.

    Parameters
    ----------
    shape : TriangleMesh
    parameters : HullParameters
    cache : ShapeCache
        Prepares the mesh and keeps it for the next call.
    labels : (P,) int, optional
        Part of each polygon, from 0; each is one piece with ``pieces="PARTS"``.
    seed : int
        Seed of the random surface samples.

    Returns
    -------
    Steps of HullDecomposition
        Shapes in the units of the mesh, the largest first.

    Raises
    ------
    DecompositionError
        If the shape is a point cloud, or cannot be normalized.
    """
    if not isinstance(shape, TriangleMesh):
        raise DecompositionError("A cloud has no faces; give it a surface for hulls.")
    prepared = yield from within(cache.prepare(shape), 0.0, 0.0)
    size = float(np.ptp(shape.bounds, axis=0).max()) / 2
    solid = yield from _scaled_solid(prepared, shape.diagonal / size, seed)
    numbers, parts = _parts_of_triangles(shape, labels)
    pieces = yield from _pieces_of(solid, parts, parameters)
    shapes, rows = [], []
    for piece in pieces:
        yield Progress("Shapes", 1.0)
        shapes.append(fit_shape(piece.hull, parameters, size).moved(size, shape.center))
        rows.append(_main_part(solid, parts, piece))
    errors = np.array([piece.error for piece in pieces])
    ratio = _volume_ratio(shapes, float(solid.volumes.sum()) * size**3)
    notes = (*prepared.notes, *_notes(pieces, parameters, size))
    return HullDecomposition(tuple(shapes), errors, numbers[rows], ratio, notes)


def _scaled_solid(prepared: PreparedShape, scale: float, seed: int) -> Steps[Solid]:
    """Return the solid of a mesh in CoACD's units, where its longest side is 2."""
    assert prepared.solid is not None  # None for point clouds only
    yield Progress("Solid", 0.0)
    vertices = prepared.solid.vertices * scale
    steps = solid_of(replace(prepared.solid, vertices=vertices), seed)
    return (yield from within(steps, 0.0, 0.0))


def _pieces_of(
    solid: Solid, parts: NDArray[np.int64], parameters: HullParameters
) -> Steps[list[Piece]]:
    """Return the pieces that get a hull each, the largest first."""
    if parameters.pieces == "PARTS":
        start = [piece_of_part(solid, parts == part) for part in np.unique(parts)]
        pieces = yield from join_pieces(start, 0.0, parameters.max_hulls)
    else:
        pieces = yield from _within_error(solid, parameters)
    # Rounded, so that pieces of equal size stay in the order they were cut in.
    return sorted(pieces, key=lambda piece: -round(piece.hull.volume, 6))


def _volume_ratio(shapes: list[CollisionShape], volume: float) -> float:
    """Return the volume of all shapes over that of the solid; `inf` if it is flat."""
    total = sum(shape.volume for shape in shapes)
    return total / volume if volume > 0 else np.inf


def _parts_of_triangles(
    mesh: TriangleMesh, labels: NDArray[np.int64] | None
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the numbers of the parts, (K,), and the row of each triangle's, (T,).

    Without labels, all triangles are in one part of number −1.
    """
    if labels is None:
        return np.array([-1]), np.zeros(len(mesh.triangles), dtype=np.int64)
    return np.unique(labels[mesh.polygons], return_inverse=True)


def _within_error(solid: Solid, parameters: HullParameters) -> Steps[list[Piece]]:
    """Cut and join pieces until errors are allowed, with `max_hulls` pieces at most."""
    most = parameters.max_hulls
    cells = yield from within(
        _cut(solid, parameters.max_error, int(_SURPLUS * most)), 0.0, 0.9
    )
    return (yield from within(join_pieces(cells, parameters.max_error, most), 0.9, 1.0))


def _cut(solid: Solid, max_error: float, most: int) -> Steps[list[Cell]]:
    """Cut the piece of largest error repeatedly, into `most` pieces at most."""
    cells = [whole(solid)]
    done: list[Cell] = []
    while cells and len(cells) + len(done) < most:
        share = (len(cells) + len(done)) / most
        worst = max(cells, key=lambda cell: round(cell.error, 6))
        if worst.error <= max_error:
            break
        cells.remove(worst)
        sides = yield from within(best_cut(solid, worst), share, share + 1 / most)
        if sides:
            cells += sides
        else:
            done.append(worst)
    return done + cells


def _main_part(solid: Solid, parts: NDArray[np.int64], piece: Piece) -> int:
    """Return the part of most of the surface samples in a piece's hull, of `parts`."""
    if not parts.any():  # there is only part 0
        return 0
    low, high = piece.hull.vertices.min(axis=0), piece.hull.vertices.max(axis=0)
    near = ((low <= solid.samples) & (solid.samples <= high)).all(axis=1)
    near[near] = piece.hull.heights(solid.samples[near]) <= 0
    return int(np.bincount(parts[solid.triangles[near]], minlength=1).argmax())


def _notes(
    pieces: list[Piece], parameters: HullParameters, unit: float
) -> tuple[str, ...]:
    """Return notes on errors above `max_error`, and on hulls that did not shrink."""
    notes = []
    error = max(piece.error for piece in pieces)
    if parameters.pieces != "PARTS" and error > parameters.max_error:
        notes.append(
            f"The error is {error:.3f}, above Largest Error, after as many cuts as"
            f" Most Hulls = {parameters.max_hulls} allows; raise Most Hulls for more."
        )
    margin = parameters.margin / unit
    if parameters.shape == "HULL" and margin < 0:
        kept = sum(offset(piece.hull, margin) is piece.hull for piece in pieces)
        if kept:
            notes.append(
                f"Margin = {parameters.margin:g} would make {kept} of {len(pieces)}"
                " hulls vanish, which keep their size; choose a value nearer to 0."
            )
    return tuple(notes)
