"""Shells that run through each other, such as the boards of a fence, as pieces."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...geometry.mesh import TriangleMesh
from ...geometry.sampling import sample_surface
from ...solids.convexity import is_convex
from ...solids.shells import find_shells
from ...solids.volume import volumes_of
from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.progress import Progress, Steps
from ..convex_hull import hull_volume
from ..measure.inside import inside_test
from ..piece import BURIED
from ..solid import Solid
from .cell import Cell

# How far in front of a surface places are that others hold where it is buried.
_BEFORE = 1e-4
# A shell that sticks out of another by so little is held.
_BESIDE = 1e-9


def shells_of(cell: Cell, most: int) -> Steps[list[Cell]]:
    """Return the shells of a whole as pieces, each with the cavities in it.

    Parameters
    ----------
    cell : Cell
        The whole.
    most : int
        Largest number of pieces; if there are more, none is returned.

    Returns
    -------
    Steps of list of Cell
    """
    solid, volumes = cell.solid, dict[Cell, float]()
    if not 1 < len(solid.shells.closed) <= most:
        return []
    owners = yield from _owners(solid)
    hidden, triangles = yield from _buried(solid)
    for row in np.unique(owners).tolist():
        chosen = owners == row
        convex = solid.closed and (yield from _is_convex(solid.mesh, chosen))
        buried = hidden[chosen[triangles]]
        piece = yield from _piece(cell, chosen, buried, convex)
        yield Progress("Solid", 1.0)
        volumes[piece] = round(piece.hull.volume, 6)
    kept = list[Cell]()
    for piece in sorted(volumes, key=lambda one: -volumes[one]):
        held = False
        for one in kept:
            yield Progress("Solid", 1.0)
            held = held or (one.convex and _holds(one, piece))
        kept += [] if held else [piece]
    return kept


def _owners(solid: Solid) -> Steps[IntArray]:
    """Return the shell of each triangle (T,); of a cavity, the one that it is in."""
    shells = solid.shells
    volumes = np.bincount(shells.of_triangle, (yield from volumes_of(solid.mesh)))
    lows, highs = shells.bounds(solid.mesh)
    owners = np.arange(len(volumes))
    for row in np.flatnonzero(volumes < 0):
        around = (lows <= lows[row]) & (highs >= highs[row])
        around = np.flatnonzero(around.all(axis=1) & (volumes > 0))
        if len(around):
            owners[row] = around[volumes[around].argmin()]
    return owners[shells.of_triangle]


def _buried(solid: Solid) -> Steps[tuple[FloatArray, IntArray]]:
    """Return points spread over what is buried of the surface, and their triangles."""
    if solid.surface is solid.mesh:
        return np.zeros((0, 3)), np.zeros(0, dtype=np.int64)
    count = int(solid.mesh.areas.sum() / solid.spacing**2)
    samples = sample_surface(solid.mesh, count, np.random.default_rng(0))
    before = samples.positions + _BEFORE * samples.normals
    held = yield from solid.inside.which_held(before)
    return samples.positions[held], samples.triangles[held]


def _is_convex(mesh: TriangleMesh, chosen: BoolArray) -> Steps[bool]:
    """Return whether some triangles of a mesh are the surface of a convex solid."""
    used, rows = np.unique(mesh.triangles[chosen], return_inverse=True)
    triangles = rows.reshape(-1, 3)
    part = TriangleMesh(mesh.vertices[used], triangles, mesh.polygons[chosen])
    return (yield from is_convex(part, (yield from find_shells(part))))


def _holds(one: Cell, other: Cell) -> bool:
    """Return whether the hull of one piece holds another."""
    (low, high), (lowest, highest) = one.hull.bounds, other.hull.bounds
    if (lowest < low - _BESIDE).any() or (highest > high + _BESIDE).any():
        return False
    # Heights above all faces take long where there are thousands.
    both = hull_volume(np.concatenate([one.extremes, other.extremes]))
    return both <= one.hull.volume * (1 + _BESIDE)


def _piece(
    cell: Cell, chosen: BoolArray, hidden: FloatArray, convex: bool
) -> Steps[Cell]:
    """Return a shell as a piece; `hidden` (M, 3) are points where others bury it."""
    solid, samples = cell.solid, chosen[cell.triangles]
    points = solid.mesh.vertices[np.unique(solid.mesh.triangles[chosen])]
    low, high, faces = points.min(axis=0), points.max(axis=0), solid.corners[chosen]
    chords = np.flatnonzero(((low <= cell.places) & (cell.places <= high)).all(axis=1))
    test = yield from inside_test(faces, 1 if solid.closed else 3)
    inside = yield from test.which_held(cell.places[chords])
    buried = np.full(len(hidden), BURIED)
    return replace(
        cell,
        points=points,
        boundary=np.concatenate([cell.boundary[samples], hidden]),
        triangles=np.concatenate([cell.triangles[samples], buried]),
        chords=chords[inside],
        faces=faces,
        convex=convex,
    )
