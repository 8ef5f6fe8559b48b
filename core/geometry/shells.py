"""Connected shells of triangles: whether they are closed, and their winding."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from .frames import unit
from .mesh import TriangleMesh

# Shells are moved inwards by multiples of this depth, in diagonals.
_LAYER = 1e-5
# Number of different depths, with 0. They are used in turn, by descending area.
_LAYERS = 8


@dataclass(frozen=True, eq=False)
class Shells:
    """The shells of a mesh: triangles connected by edges of exactly two triangles.

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

    of_triangle: NDArray[np.int64]
    against: NDArray[np.bool_]
    windable: NDArray[np.bool_]
    closed: NDArray[np.bool_]


def find_shells(mesh: TriangleMesh) -> Shells:
    """Return the connected shells of a mesh.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    Shells
    """
    corners = mesh.welded_triangles
    n_triangles = len(corners)
    forward = (corners < np.roll(corners, -1, axis=1)).ravel()
    keys = mesh.edge_keys
    order = np.argsort(keys, kind="stable")
    first = np.flatnonzero(np.diff(keys[order], prepend=-1))
    uses = np.diff(first, append=len(order))
    paired = order[first[uses == 2][:, None] + [0, 1]]
    opposed = forward[paired[:, 0]] != forward[paired[:, 1]]
    copies = _wound_copies(paired // 3, opposed, n_triangles)
    _, shells = np.unique(copies.min(axis=0), return_inverse=True)
    shells = shells.reshape(-1)
    n_shells = int(shells.max()) + 1
    side = copies[0] > copies[1]
    minority = np.bincount(shells, side) * 2 > np.bincount(shells)
    windable = np.bincount(shells, copies[0] == copies[1], n_shells) == 0
    # At an edge of four triangles a shell may touch itself.
    edge_of = np.repeat(np.arange(len(uses)), uses)
    others = (uses != 2)[edge_of]
    owners = shells[order[others] // 3] * len(uses) + edge_of[others]
    uses_by_shell, counts = np.unique(owners, return_counts=True)
    open_edges = uses_by_shell[counts % 2 == 1] // len(uses)
    closed = windable.copy()
    closed[open_edges] = False
    against = (side ^ minority[shells]) & windable[shells]
    return Shells(shells, against, windable, closed)


def set_apart(mesh: TriangleMesh, shells: Shells) -> TriangleMesh:
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
    TriangleMesh
        The same object if there is only one shell.
    """
    areas = np.bincount(shells.of_triangle, mesh.areas)
    if len(areas) == 1:
        return mesh
    ranks = np.argsort(np.argsort(-areas, kind="stable"))
    steps = ranks[shells.of_triangle] % _LAYERS
    vectors = (mesh.areas[:, None] * mesh.normals).repeat(3, axis=0)
    corners = mesh.triangles.ravel()
    normals = np.stack(
        [np.bincount(corners, v, len(mesh.vertices)) for v in vectors.T], axis=1
    )
    depths = np.zeros(len(mesh.vertices))
    depths[corners] = _LAYER * mesh.diagonal * steps.repeat(3)
    inwards = depths[:, None] * unit(np.asarray(normals, dtype=np.float64))
    return replace(mesh, vertices=mesh.vertices - inwards)


def _wound_copies(
    neighbors: NDArray[np.int64], opposed: NDArray[np.bool_], n_triangles: int
) -> NDArray[np.int64]:
    """Return the component of each triangle as it is, and of its flipped copy, (2, T).

    An edge connects the copies whose windings agree. A shell can be wound consistently
    if no triangle is in one component with its flipped copy.
    """
    one, other = neighbors.T
    turned = np.where(opposed, 0, n_triangles)
    ties = sparse.coo_array(
        (
            np.ones(2 * len(one), dtype=bool),
            (
                np.concatenate([one, one + n_triangles]),
                np.concatenate([other + turned, other + n_triangles - turned]),
            ),
        ),
        shape=(2 * n_triangles, 2 * n_triangles),
    )
    _, components = connected_components(ties, directed=False)
    return components.astype(np.int64).reshape(2, n_triangles)
