"""Choose the directions along which planes through a piece are tried."""

from __future__ import annotations

import numpy as np

from ...geometry.frames import area_vectors, distinct_directions, principal_axes, unit
from ...steps.arrays import FloatArray
from .cell import Cell

# Two directions count as the same above this cosine between them.
_SAME = 0.995
# A block has at least this share of its surface in large flat faces, in this many
# directions at least. With half of it, pieces of coarse meshes would count as blocks.
_BLOCK, _SIDES = 0.9, 3
# Large faces, with those parallel to them, have at least this share of the surface.
_LARGE_FACE = 0.05
# Decimal digits to which the normals of parallel faces agree.
_NORMAL_DIGITS = 3


def directions_of(cell: Cell) -> tuple[FloatArray, bool]:
    """Return the normals of planes to try, and whether the piece is a block.

    Blocks are cut along their faces alone, however they are turned; others along the
    coordinate axes and their own. Planes along the seams of weakly convex parts
    measured worse as first cuts, and so did planes along the flat faces of shapes that
    are no blocks.

    Parameters
    ----------
    cell : Cell

    Returns
    -------
    directions : (D, 3) float
        Unit vectors.
    is_block : bool
    """
    flat, share = _flat_normals(cell)
    if len(flat) >= _SIDES and share >= _BLOCK:
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
    normals = unit(area_vectors(corners))
    found, counts = distinct_directions(normals, _NORMAL_DIGITS)
    large = counts >= _LARGE_FACE * len(normals)
    flat = found[large][np.argsort(-counts[large], kind="stable")]
    return flat, float(counts[large].sum() / max(len(normals), 1))
