"""Triangles that lie on top of each other, as left by a copy that was joined."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..geometry.mesh import TriangleMesh
from ..steps.beside import beside
from ..steps.progress import Progress, Steps
from ..steps.rows import blocks


def without_doubles(
    mesh: TriangleMesh,
) -> Steps[tuple[TriangleMesh, NDArray[np.int64]]]:
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
    places = mesh.welded_triangles
    n_places = int(places.max()) + 1
    key, last = np.empty((2, len(places)), dtype=np.int64)
    for some in blocks(len(places)):
        yield Progress("Surface", 0.2 * some.start / len(places))
        # Let each triangle begin at its smallest corner. This keeps its winding.
        columns = (places[some].argmin(axis=1)[:, None] + [0, 1, 2]) % 3
        first, second, last[some] = np.take_along_axis(places[some], columns, axis=1).T
        key[some] = first.astype(np.int64) * n_places + second
    order = yield from beside(lambda: np.lexsort((last, key)), "Surface")
    key, last = key[order], last[order]
    yield Progress("Surface", 0.6)
    new = np.ones(len(order), dtype=bool)
    new[1:] = (key[1:] != key[:-1]) | (last[1:] != last[:-1])
    kept = np.sort(order[new])
    yield Progress("Surface", 0.8)
    rows = np.empty(len(order), dtype=np.int64)
    rows[order] = np.searchsorted(kept, order[new])[np.cumsum(new) - 1]
    if len(kept) == len(order):
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
