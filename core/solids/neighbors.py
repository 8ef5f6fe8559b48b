"""Which triangles are neighbors across an edge, also where solids touch."""

from __future__ import annotations

import numpy as np

from ..geometry.frames import cross, unit
from ..geometry.graphs.edges import (
    Edges,
    ends_of_sides,
    places_of_sides,
    sides_forward,
)
from ..geometry.mesh import TriangleMesh
from ..steps.arrays import BoolArray, FloatArray, Int32Array
from ..steps.progress import Progress, Steps, within
from ..steps.rows import blocks
from .slivers import solid_edges
from .volume import signed_volume

# Angle between triangles on top of each other, in radians: more than rounding.
_SAME_ANGLE = 1e-3
# An edge with more triangles is left alone: no solids touch like this.
_MOST_USES = 32
# About the most pairs of sides whose angles are found in one step.
_MOST_PAIRS = 2**16


def find_neighbors(mesh: TriangleMesh) -> Steps[tuple[Int32Array, BoolArray]]:
    """Return pairs of triangles that are neighbors across an edge.

    Those are the two triangles of an edge. Where solids touch, edges have more. If as
    many run along an edge one way as the other way, those pair up that have the least
    inside between them. Of others, those pair up that have the same vertices there,
    and no third one has. Collapsed triangles have no neighbors.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    neighbors : (N, 2) int32
        Pairs of triangles.
    opposed : (N,) bool
        Whether they run along the edge in opposite directions, as they should.
    """
    edges, _ = yield from within(solid_edges(mesh), 0.0, 0.2)
    sides, first = edges
    forward = yield from within(sides_forward(mesh), 0.2, 0.4)
    uses = edges.uses
    yield Progress("Surface", 0.5)
    two = first[uses == 2]
    yield Progress("Surface", 0.6)
    one, other = sides[two], sides[1:][two]
    if edges.crowded:
        pairs = yield from _pairs_at_crowded(mesh, edges, forward)
        one, other = np.concatenate([[one, other], pairs], axis=1)
    yield Progress("Surface", 0.8)
    opposed = forward[one] != forward[other]
    yield Progress("Surface", 0.9)
    neighbors = np.empty((len(one), 2), dtype=sides.dtype)
    neighbors[:, 0] = one // 3
    neighbors[:, 1] = other // 3
    return neighbors, opposed


def _pairs_at_crowded(
    mesh: TriangleMesh, edges: Edges, forward: BoolArray
) -> Steps[Int32Array]:
    """Return pairs (2, N) of sides at edges of more than two triangles."""
    inside_out = (yield from within(signed_volume(mesh), 0.6, 0.7)) < 0
    uses = edges.uses
    crowded = np.flatnonzero((uses > 2) & (uses <= _MOST_USES))
    uses, first = uses[crowded], edges.first[crowded]
    pairs = [np.zeros((2, 0), dtype=np.int32)]
    for n_uses in np.unique(uses).tolist():
        chosen = first[uses == n_uses]
        for rows in blocks(len(chosen), _MOST_PAIRS // n_uses**2):
            yield Progress("Surface", 0.7)
            sides = edges.sides[chosen[rows, None] + np.arange(n_uses)]
            ahead = forward[sides]
            balanced = 2 * ahead.sum(axis=1) == n_uses
            if balanced.any():
                order = np.argsort(~ahead[balanced], axis=1, kind="stable")
                some = np.take_along_axis(sides[balanced], order, axis=1)
                pairs.append(_least_apart(mesh, some, inside_out))
            pairs.append(_with_own_vertices(mesh, sides[~balanced]))
    return np.concatenate(pairs, axis=1)


def _least_apart(mesh: TriangleMesh, sides: Int32Array, inside_out: bool) -> Int32Array:
    """Return pairs (2, N) of sides at E edges that have the least inside between them.

    `sides` (E, 2H) are those that run along each edge one way, then the other way.
    """
    one, other = np.split(sides, 2, axis=1)
    angles = _angles(mesh, one, other, inside_out)
    n_edges, half = one.shape
    edges = np.arange(n_edges)
    pairs = []
    for _ in range(half):
        i, j = np.divmod(angles.reshape(n_edges, -1).argmin(axis=1), half)
        pairs.append(np.stack([one[edges, i], other[edges, j]]))
        angles[edges, i], angles[edges, :, j] = np.inf, np.inf
    return np.concatenate(pairs, axis=1)


def _angles(
    mesh: TriangleMesh, one: Int32Array, other: Int32Array, inside_out: bool
) -> FloatArray:
    """Return the angles between triangles at E edges, through the inside, (E, H, H).

    `one` (E, H) are sides that run along an edge, `other` (E, H) those against it.
    Triangles on top of each other have all of the inside between them.
    """
    starts, ends, _ = places_of_sides(mesh, one[:, :1])
    along = unit((ends - starts).reshape(-1, 3))[:, None]

    def away(some: Int32Array) -> FloatArray:
        """Directions (E, H, 3) of triangles, at right angles to the edge."""
        offsets = places_of_sides(mesh, some)[2] - starts
        offsets -= (offsets * along).sum(axis=2, keepdims=True) * along
        return unit(offsets.reshape(-1, 3)).reshape(offsets.shape)

    ahead, back = away(one), away(other)
    inwards = cross(ahead, np.broadcast_to(along, ahead.shape))
    if inside_out:
        inwards = -inwards
    angles = np.arctan2(
        np.einsum("ehd,egd->ehg", inwards, back),
        np.einsum("ehd,egd->ehg", ahead, back),
    )
    return np.where(angles < _SAME_ANGLE, angles + 2 * np.pi, angles)


def _with_own_vertices(mesh: TriangleMesh, sides: Int32Array) -> Int32Array:
    """Return pairs (2, N) of sides (E, U) with vertices that no other side there has.

    Objects that were joined keep their vertices.
    """
    ends = ends_of_sides(mesh.triangles, sides)
    keys = np.minimum(*ends) * len(mesh.vertices) + np.maximum(*ends)
    order = np.argsort(keys, axis=1, kind="stable")
    keys = np.take_along_axis(keys, order, axis=1)
    alike = np.zeros((len(keys), keys.shape[1] + 1), dtype=bool)
    alike[:, 1:-1] = keys[:, 1:] == keys[:, :-1]
    rows, columns = np.nonzero(alike[:, 1:-1] & ~alike[:, :-2] & ~alike[:, 2:])
    return np.stack([sides[rows, order[rows, columns + i]] for i in range(2)])
