"""Walls without thickness, such as those of a crate of single faces, as plates.

Cuts find them late: while two walls are left, their hull strays as far as that of all.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...geometry.frames import (
    area_vectors,
    coordinates_along,
    one_way,
    settled,
    unit,
)
from ...steps.arrays import BoolArray, FloatArray
from .cell import Cell

# Decimal digits to which the planes of faces agree that are one wall.
_DIGITS = 3
# How far beside its faces a plate ends.
_BESIDE = 1e-7


def plates_of(cell: Cell, most: int) -> list[Cell]:
    """Return the faces of an open whole as pieces, those in one plane as one.

    Parameters
    ----------
    cell : Cell
        The whole.
    most : int
        Largest number of pieces; if there are more, none is returned.

    Returns
    -------
    list of Cell
    """
    if cell.solid.closed:
        return []
    planes = _planes_of(cell.solid.corners)
    has_plane = planes[:, :3].any(axis=1)  # triangles without area have none
    rows = np.full(len(planes), -1)
    rounded = np.round(planes[has_plane], _DIGITS)
    if len(np.unique(rounded[:, 3])) > most:  # to sort planes takes far longer
        return []
    rows[has_plane] = np.unique(rounded, axis=0, return_inverse=True)[1].ravel()
    count = int(rows.max()) + 1
    every = range(count if count <= most else 0)
    return [_plate(cell, rows == row, planes) for row in every]


def _planes_of(corners: FloatArray) -> FloatArray:
    """Return the planes of triangles, (T, 4): the same one of both sides."""
    normals = one_way(unit(area_vectors(corners)), _DIGITS)
    offsets = np.einsum("td,td->t", normals, corners.mean(axis=1))
    return settled(np.column_stack([normals, -offsets]))


def _plate(cell: Cell, chosen: BoolArray, planes: FloatArray) -> Cell:
    """Return triangles of a whole that lie in one plane as a piece."""
    points = cell.solid.corners[chosen].reshape(-1, 3)
    normal = planes[chosen][0, :3]
    heights = coordinates_along(normal[None], points)
    low, high = float(heights.min()) - _BESIDE, float(heights.max()) + _BESIDE
    samples = chosen[cell.triangles]
    return replace(
        cell,
        points=points,
        boundary=cell.boundary[samples],
        triangles=cell.triangles[samples],
        chords=cell.chords[:0],
        planes=np.array([[*normal, -high], [*-normal, low]]),
    )
