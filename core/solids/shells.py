"""Connected shells of triangles: whether they are closed, and their winding."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..geometry.frames import unit
from ..geometry.graphs.components import components
from ..geometry.mesh import TriangleMesh
from ..steps.arrays import BoolArray, FloatArray, Int32Array, IntArray
from ..steps.progress import Progress, Steps, within
from ..steps.rows import blocks, used_rows
from .neighbors import find_neighbors
from .slivers import hosts, solid_edges

# Shells are moved inwards by multiples of this depth, in diagonals.
_LAYER = 1e-5
# Number of different depths, with 0. They are used in turn, by descending area.
_LAYERS = 8
# About the widest gap that this makes between shells, along a slanted ray.
GAP = 4 * _LAYER * _LAYERS


@dataclass(frozen=True, eq=False)
class Shells:
    """The shells of a mesh: triangles that are connected across edges.

    Attributes
    ----------
    of_triangle : (T,) int
        Shell of each triangle.
    against : (T,) bool
        Triangles to flip for a consistent winding. There are two ways to do it; this
        is the one that flips fewer triangles. False on shells that are not windable.
    windable : (S,) bool
        Shells that can be wound consistently, unlike a Möbius strip.
    closed : (S,) bool
        Windable shells that bound a volume: every edge has an even number of the
        shell's triangles.
    """

    of_triangle: IntArray
    against: BoolArray
    windable: BoolArray
    closed: BoolArray

    @cached_property
    def members(self) -> list[IntArray]:
        """Triangles of each shell, ascending."""
        order = np.argsort(self.of_triangle, kind="stable")
        return np.split(order, np.cumsum(np.bincount(self.of_triangle))[:-1])

    def bounds(self, mesh: TriangleMesh) -> tuple[FloatArray, FloatArray]:
        """Return the lowest and highest coordinates of each shell of a mesh, (S, 3)."""
        counts = np.bincount(self.of_triangle)
        firsts = np.cumsum(counts) - counts
        corners = mesh.vertices[mesh.triangles[np.concatenate(self.members)]]
        lows = np.minimum.reduceat(corners.min(axis=1), firsts)
        return lows, np.maximum.reduceat(corners.max(axis=1), firsts)


def find_shells(mesh: TriangleMesh) -> Steps[Shells]:
    """Return the connected shells of a mesh.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    Steps of Shells
    """
    edges, left_out = yield from within(solid_edges(mesh), 0.0, 0.1)
    neighbors, opposed = yield from within(find_neighbors(mesh), 0.1, 0.2)
    if left_out.any():
        ties = yield from within(hosts(mesh, left_out), 0.2, 0.2)
        neighbors = np.concatenate([neighbors, ties])
        opposed = np.concatenate([opposed, np.ones(len(ties), dtype=bool)])
    shells, side, windable = yield from _wind(neighbors, opposed, len(mesh.areas))
    yield Progress("Surface", 0.8)
    minority = np.bincount(shells, side) * 2 > np.bincount(shells)
    sides, uses = edges.sides, edges.uses
    # At an edge of four triangles a shell may touch itself.
    edge_of = np.repeat(np.flatnonzero(uses != 2), uses[uses != 2])
    others = sides[np.repeat(uses != 2, uses)]
    owners = shells[others // 3] * len(uses) + edge_of
    uses_by_shell, counts = np.unique(owners, return_counts=True)
    open_edges = uses_by_shell[counts % 2 == 1] // len(uses)
    closed = windable.copy()
    closed[open_edges] = False
    against = (side ^ minority[shells]) & windable[shells]
    return Shells(shells, against, windable, closed)


def set_apart(mesh: TriangleMesh, shells: Shells) -> Steps[TriangleMesh]:
    """Return `mesh` with its shells shrunk slightly, to different depths.

    Boxes are often put together flush. A ray cannot order faces at the same place, nor
    count the shells there. Gaps of 1e-5 of the diagonal are enough for that, and too
    small to be seen.

    Parameters
    ----------
    mesh : TriangleMesh
    shells : Shells
        Shells of `mesh`.

    Returns
    -------
    Steps of TriangleMesh
        The same object if there is only one shell.
    """
    areas = np.bincount(shells.of_triangle, mesh.areas)
    if len(areas) == 1:
        return mesh
    ranks = np.argsort(np.argsort(-areas, kind="stable"))
    depths = _LAYER * mesh.diagonal * (ranks % _LAYERS)
    rows, shell_of, vertices = yield from _own_vertices(mesh, shells)
    normals = np.empty_like(vertices)
    for axis, column in enumerate(mesh.normals.T):
        yield Progress("Surface", 0.6 + 0.1 * axis)
        weights = (mesh.areas * column).repeat(3)
        normals[:, axis] = np.bincount(rows.ravel(), weights, len(vertices))
    yield Progress("Surface", 0.9)
    moved = vertices - depths[shell_of][:, None] * unit(normals)
    return replace(mesh, vertices=moved, triangles=rows)


def _own_vertices(
    mesh: TriangleMesh, shells: Shells
) -> Steps[tuple[IntArray, IntArray, FloatArray]]:
    """Return vertices of which each belongs to one place and one shell.

    A shell moves as one, though its vertices be split, and by itself, though it share
    them with another one.

    Returns
    -------
    rows : (T, 3) int
        Row of the vertex of each corner.
    shell_of : (V,) int
        Shell of each vertex.
    vertices : (V, 3) float
    """
    places = yield from within(mesh.welded_in_steps(), 0.0, 0.1)
    # Places of vertices without triangles are left out.
    used = yield from within(used_rows(places, int(places.max()) + 1), 0.1, 0.2)
    rows, row_of_place = np.empty(places.shape, dtype=np.int64), np.cumsum(used) - 1
    n_places = int(row_of_place[-1]) + 1
    shell_of = np.empty(n_places, dtype=np.int64)
    vertices = np.empty((n_places, 3))
    for some in blocks(len(places)):
        yield Progress("Surface", 0.2)
        rows[some] = row_of_place[places[some]]
        shell_of[rows[some]] = shells.of_triangle[some, None]
        vertices[rows[some]] = mesh.vertices[mesh.triangles[some]]
    yield Progress("Surface", 0.4)
    # Where shells share a place, all but one of them get a further vertex.
    strange = np.flatnonzero(shell_of[rows] != shells.of_triangle[:, None])
    keys = rows.ravel()[strange] * len(shells.closed) + shells.of_triangle[strange // 3]
    yield Progress("Surface", 0.5)
    keys, more = np.unique(keys, return_inverse=True)
    rows.ravel()[strange] = n_places + more
    yield Progress("Surface", 0.6)
    shell_of = np.concatenate([shell_of, keys % len(shells.closed)])
    vertices = np.concatenate([vertices, vertices[keys // len(shells.closed)]])
    return rows, shell_of, vertices


def _wind(
    neighbors: Int32Array, opposed: BoolArray, n_triangles: int
) -> Steps[tuple[IntArray, BoolArray, BoolArray]]:
    """Return the shell of each triangle, and how shells are wound.

    Parameters
    ----------
    neighbors : (E, 2) int
        Triangles with a common edge.
    opposed : (E,) bool
        Whether they run along it in opposite directions, as they should.
    n_triangles : int
        Number of triangles T.

    Returns
    -------
    shells : (T,) int
        Numbered in the order of their first triangles.
    side : (T,) bool
        Triangles wound against the first one of their shell; False on shells that are
        not windable.
    windable : (S,) bool
        Whether a shell can be wound consistently.
    """
    # Triangles that are wound alike are one node, of which there is a flipped copy. An
    # edge connects the copies whose windings agree.
    alike = neighbors if opposed.all() else neighbors[opposed]
    yield Progress("Surface", 0.2)
    steps = components(alike, n_triangles)
    patches = yield from within(steps, 0.2, 0.6)
    n_patches = int(patches.max()) + 1
    one, other = patches[neighbors[~opposed]].T
    ties = np.concatenate(
        [
            np.stack([one, other + n_patches], axis=1),
            np.stack([one + n_patches, other], axis=1),
        ]
    )
    copies = yield from within(components(ties, 2 * n_patches), 0.6, 0.8)
    copies = copies.reshape(2, n_patches)
    _, shells = np.unique(copies.min(axis=0), return_inverse=True)
    windable = np.bincount(shells, copies[0] == copies[1]) == 0
    side = copies[0] > copies[1]
    return shells[patches], side[patches], windable
