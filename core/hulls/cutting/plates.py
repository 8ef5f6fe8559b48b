"""Walls without thickness, such as those of a crate of single faces, as plates.

Cuts find them late: while two walls are left, their hull strays as far as that of all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from ...geometry.frames import (
    area_vectors,
    coordinates_along,
    one_way,
    settled,
    unit,
)
from ...steps.arrays import BoolArray, FloatArray
from ...steps.progress import Steps, within
from ..piece import Piece
from .cell import Cell
from .close_pieces import close_pieces

# Largest number of planes that walls lie in, as a multiple of Most Hulls.
_SURPLUS = 2
# Decimal digits to which the planes of faces agree that are one wall.
_DIGITS = 3
# How far beside its faces a plate ends.
_BESIDE = 1e-7


def pieces_or_plates(cell: Cell, most: int) -> Steps[list[Piece]]:
    """Cut a whole until all pieces are close; of an open one, try its walls as well.

    Parameters
    ----------
    cell : Cell
        The whole.
    most : int
        Largest number of pieces to return.

    Returns
    -------
    Steps of list of Piece
        What keeps to the largest error, or strays less. Then the fewer ones.
    """
    plates = [] if cell.solid.closed or cell.is_close else _plates_of(cell, most)
    if not plates:
        return (yield from close_pieces([cell], most))
    walls = yield from within(close_pieces(plates, most), 0.0, 0.5)
    if all(one.is_close for one in walls):
        most = len(walls)
    pieces = yield from within(close_pieces([cell], most), 0.5, 1.0)
    return min(pieces, walls, key=partial(_rank, cell.fit.max_error))


def _rank(largest: float, pieces: Sequence[Piece]) -> tuple[float, int]:
    """Return how far pieces stray, if further than allowed, and how many they are."""
    return max(largest, *(one.bound.value for one in pieces)), len(pieces)


def _plates_of(cell: Cell, most: int) -> list[Cell]:
    """Return the faces in each plane as a piece, of few planes: none of others."""
    planes = _planes_of(cell.solid.corners)
    has_plane = planes[:, :3].any(axis=1)  # triangles without area have none
    rows = np.full(len(planes), -1)
    rounded = np.round(planes[has_plane], _DIGITS)
    rows[has_plane] = np.unique(rounded, axis=0, return_inverse=True)[1].ravel()
    count = int(rows.max()) + 1
    if count > _SURPLUS * most:
        return []
    return [_plate(cell, rows == row, planes) for row in range(count)]


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
        volume=0.0,
        chords=cell.chords[:0],
        volumes=cell.volumes[:0],
        planes=np.array([[*normal, -high], [*-normal, low]]),
    )
