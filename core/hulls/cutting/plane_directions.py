"""Choose the directions along which planes through a piece are tried."""

from __future__ import annotations

import numpy as np

from ...geometry.cutting.segments import segments_below
from ...geometry.flat import flat_mesh
from ...geometry.frames import (
    area_vectors,
    cross,
    distinct_directions,
    principal_axes,
    unit,
)
from ...geometry.mesh import TriangleMesh
from ...steps.arrays import FloatArray
from .cell import Cell

# Two directions count as the same above this cosine between them.
_SAME = 0.995
# A block has at least this share of its surface in large flat faces, in this many
# directions at least. With half of it, pieces of coarse meshes would count as blocks.
# The same holds for a sheet and the straight sides of its outline.
_BLOCK, _SIDES, _SIDES_OF_SHEET = 0.9, 3, 2
# Large faces, with those parallel to them, have at least this share of the surface.
_LARGE_FACE = 0.05
# Decimal digits to which the normals of parallel faces agree.
_NORMAL_DIGITS = 3
# An outline is counted in so many parts: rounding does not tell equal sides apart.
_PARTS = 1000


def directions_of(cell: Cell) -> tuple[FloatArray, bool]:
    """Return the normals of planes to try, and whether the piece is a block.

    Blocks are cut along their faces alone, however they are turned, and sheets with
    straight sides along those; others along the coordinate axes and their own. Planes
    along the seams of weakly convex parts measured worse as first cuts, and so did
    planes along the flat faces of shapes that are no blocks.

    Parameters
    ----------
    cell : Cell

    Returns
    -------
    directions : (D, 3) float
        Unit vectors.
    is_block : bool
        Such sheets count as blocks.
    """
    flat, share = _outline_normals(cell) if cell.is_sheet else _flat_normals(cell)
    n_sides = _SIDES_OF_SHEET if cell.is_sheet else _SIDES
    if len(flat) >= n_sides and share >= _BLOCK:
        return flat, True
    own = principal_axes(cell.boundary if len(cell.boundary) else cell.points)
    across = [own[0]] if cell.is_sheet else []  # there is nothing to part
    found: list[FloatArray] = []
    for direction in (*np.eye(3), *own):
        if all(abs(direction @ other) < _SAME for other in (*across, *found)):
            found.append(direction)
    return np.array(found), False


def _flat_normals(cell: Cell) -> tuple[FloatArray, float]:
    """Return the normals of a piece's large flat faces, (N, 3), and their share of all.

    The first has most of the surface. Parallel faces count together.
    """
    # Those of all triangles may take long.
    corners = cell.solid.corners[cell.triangles[cell.on_surface]]
    return _large(unit(area_vectors(corners)))


def _outline_normals(cell: Cell) -> tuple[FloatArray, float]:
    """Return the same for the straight sides of a sheet, in its plane, by length."""
    corners = cell.corners[area_vectors(cell.corners).any(axis=1)]
    rows = np.arange(len(corners))
    triangles = 3 * rows[:, None] + np.arange(3)
    places = corners.reshape(-1, 3)
    flat = flat_mesh(TriangleMesh(places, triangles, rows)) if len(rows) else None
    if flat is None:
        return np.zeros((0, 3)), 0.0
    sides = segments_below(cell.planes, flat.outline)
    along = sides[:, 1] - sides[:, 0]
    lengths = np.linalg.norm(along, axis=1)
    times = np.round(_PARTS * lengths / max(lengths.sum(), 1e-9)).astype(np.int64)
    across = unit(cross(along, np.broadcast_to(flat.normal, along.shape)))
    return _large(np.repeat(across, times, axis=0))


def _large(normals: FloatArray) -> tuple[FloatArray, float]:
    """Return the directions that many normals have, and their share of all."""
    found, counts = distinct_directions(normals, _NORMAL_DIGITS)
    large = counts >= _LARGE_FACE * len(normals)
    flat = found[large][np.argsort(-counts[large], kind="stable")]
    return flat, float(counts[large].sum() / max(len(normals), 1))
