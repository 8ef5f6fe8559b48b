"""Walls within a solid, as Merge by Distance leaves between boxes that touch."""

from __future__ import annotations

import numpy as np

from ..geometry.frames import cross, unit
from ..geometry.graphs.components import components
from ..geometry.graphs.edges import Edges, places_of_sides, sides_forward
from ..geometry.mesh import TriangleMesh
from ..steps.arrays import BoolArray, Int32Array, IntArray
from ..steps.progress import Progress, Steps, within
from ..steps.rows import blocks
from .slivers import solid_edges
from .volume import volumes_of

# A cell with less volume, in cubed diagonals, is none.
_LEAST_VOLUME = 1e-9
# Angles between triangles on top of each other, in radians, are rounded to this.
_SAME_ANGLE = 1e-5
# About the most sides of triangles that are sorted around their edges in one step.
_MOST_SIDES = 2**16


def inner_walls(mesh: TriangleMesh) -> Steps[BoolArray]:
    """Return the triangles that have the inside of a solid on both of their sides.

    A surface divides space into cells. Those with a volume are inside, whichever way
    the triangles are wound.

    Parameters
    ----------
    mesh : TriangleMesh
        No two triangles have the same corners and winding.

    Returns
    -------
    Steps of (T,) bool
    """
    edges, _ = yield from within(solid_edges(mesh), 0.0, 0.3)
    uses = edges.uses
    # The rims of walls have three triangles. Without, nothing is to be looked for.
    if not ((uses > 1) & (uses % 2 == 1)).any():
        return np.zeros(len(mesh.triangles), dtype=bool)
    cells = yield from within(_cells(mesh, edges), 0.3, 0.8)
    volumes = yield from within(volumes_of(mesh), 0.8, 1.0)
    # A cell lies in front of some of its triangles, and behind the others.
    sums = np.bincount(cells.ravel(), np.concatenate([-volumes, volumes]))
    inside = sums > _LEAST_VOLUME * mesh.diagonal**3
    in_front, behind = inside[cells]
    return in_front & behind


def _cells(mesh: TriangleMesh, edges: Edges) -> Steps[IntArray]:
    """Return the cells in front of each triangle, and behind it, (2, T)."""
    forward = yield from within(sides_forward(mesh), 0.0, 0.2)
    n_triangles, pairs = len(mesh.triangles), []
    for n_uses in np.unique(edges.uses).tolist():
        first = edges.first[edges.uses == n_uses]
        for rows in blocks(len(first), _MOST_SIDES // n_uses):
            yield Progress("Surface", 0.3)
            sides = edges.sides[first[rows, None] + np.arange(n_uses)]
            sides = _in_turn(mesh, sides, forward[sides]).astype(np.int64)
            # Turning about an edge, one leaves a triangle on one side, and comes to
            # the next one on the other side. The fronts of triangles come first.
            ahead, triangles = forward[sides], sides // 3
            leaves = np.where(ahead, triangles, n_triangles + triangles)
            comes = np.where(ahead, n_triangles + triangles, triangles)
            comes = np.roll(comes, -1, axis=1)
            pairs.append(np.stack([leaves.ravel(), comes.ravel()], axis=1))
    steps = components(np.concatenate(pairs), 2 * n_triangles)
    cells = yield from within(steps, 0.5, 1.0)
    return cells.reshape(2, n_triangles)


def _in_turn(mesh: TriangleMesh, sides: Int32Array, ahead: BoolArray) -> Int32Array:
    """Return the sides (E, U) of each edge in their order around it.

    `ahead` (E, U) are those that run from the lower place to the higher one. One turns
    counter-clockwise, seen from there.
    """
    if sides.shape[1] < 3:  # any order will do
        return sides
    starts, ends, opposite = places_of_sides(mesh, sides)
    along = np.where(ahead[..., None], ends - starts, starts - ends)[:, :1]
    along = unit(along.reshape(-1, 3))[:, None]
    away = opposite - starts
    away -= (away * along).sum(axis=2, keepdims=True) * along
    across = away[:, :1]
    turned = cross(along, across)
    angles = np.arctan2((away * turned).sum(axis=2), (away * across).sum(axis=2))
    angles = np.round(angles / _SAME_ANGLE) % np.round(2 * np.pi / _SAME_ANGLE)
    # Of triangles on top of each other, the later one counts as higher, seen from one
    # and the same side at each of their edges.
    normals = cross(np.broadcast_to(along, away.shape), away)
    up = np.take_along_axis(
        normals, np.abs(normals).argmax(axis=2, keepdims=True), axis=2
    )[..., 0]
    order = np.lexsort((sides // 3 * np.sign(up), angles), axis=1)
    return np.take_along_axis(sides, order, axis=1)
