"""Triangles that lie on top of each other, as left by a copy that was joined."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..geometry.mesh import TriangleMesh


def without_doubles(mesh: TriangleMesh) -> tuple[TriangleMesh, NDArray[np.int64]]:
    """Return a mesh with one of all triangles that have the same corners and winding.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    single : TriangleMesh
        With the vertices and numbers of polygons of `mesh`; `mesh` itself if no
        triangle is doubled.
    rows : (T,) int
        The triangle of `single` that each triangle of `mesh` lies on.
    """
    corners = mesh.welded_triangles
    # Let each triangle begin at its smallest corner. This keeps its winding.
    columns = (corners.argmin(axis=1)[:, None] + [0, 1, 2]) % 3
    _, firsts, kinds = np.unique(
        np.take_along_axis(corners, columns, axis=1),
        axis=0,
        return_index=True,
        return_inverse=True,
    )
    kept = np.sort(firsts)
    rows = np.searchsorted(kept, firsts[kinds.reshape(-1)])
    if len(kept) == len(corners):
        return mesh, rows
    single = replace(mesh, triangles=mesh.triangles[kept], polygons=mesh.polygons[kept])
    return single, rows


def with_doubles(
    mesh: TriangleMesh, single: TriangleMesh, rows: NDArray[np.int64]
) -> TriangleMesh:
    """Return a mesh whose triangles have the windings of those they lie on.

    Parameters
    ----------
    mesh : TriangleMesh
    single : TriangleMesh
        What `without_doubles` returned for it. Triangles may have been turned since.
    rows : (T,) int
        As `without_doubles` returned them.

    Returns
    -------
    TriangleMesh
        With the polygons of `mesh`.
    """
    return replace(mesh, triangles=single.triangles[rows])
