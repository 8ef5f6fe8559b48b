"""A mesh without what bounds no solid: doubled triangles, and walls within solids."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..geometry.mesh import TriangleMesh
from ..steps.arrays import BoolArray, IntArray
from ..steps.beside import beside
from ..steps.progress import Progress, Steps, within
from ..steps.rows import blocks
from .inner_walls import inner_walls
from .slivers import solid_edges


@dataclass(frozen=True, eq=False)
class BareMesh:
    """A mesh without what bounds no solid.

    Attributes
    ----------
    whole : TriangleMesh
        The mesh itself.
    mesh : TriangleMesh
        With the vertices and numbers of polygons of `whole`; `whole` itself if all its
        triangles bound solids.
    rows : (T,) int
        The triangle of `mesh` that each triangle of `whole` lies on; -1 within solids.
    """

    whole: TriangleMesh
    mesh: TriangleMesh
    rows: IntArray

    def wound_as(self, turned: TriangleMesh) -> TriangleMesh:
        """Return `whole` with the windings of `mesh` after it was turned."""
        if turned is self.mesh:
            return self.whole
        if self.mesh is self.whole:
            return turned
        outer = self.rows >= 0
        triangles = self.whole.triangles.copy()
        triangles[outer] = turned.triangles[self.rows[outer]]
        return replace(self.whole, triangles=triangles)

    def without_walls(self, whole: TriangleMesh) -> TriangleMesh:
        """Return what bounds solids of `whole`, after it was turned."""
        outer = self.rows >= 0
        return whole if outer.all() else _some(whole, outer)

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence to the user if there are walls within solids."""
        n_walls = len(np.unique(self.whole.polygons[self.rows < 0]))
        if n_walls == 0:
            return ()
        lie, bound = ("faces lie", "bound") if n_walls > 1 else ("face lies", "bounds")
        return (
            f"{n_walls} {lie} within the solid and {bound} nothing; this computation"
            " leaves out such faces (Select > Select All by Trait > Interior Faces, in"
            " Edit Mode, finds them).",
        )


def bare_mesh(whole: TriangleMesh) -> Steps[BareMesh]:
    """Return a mesh without doubled triangles, and without walls within solids.

    Of triangles with the same corners and winding, as left by a copy that was joined,
    the first stays.

    Parameters
    ----------
    whole : TriangleMesh

    Returns
    -------
    Steps of BareMesh
    """
    rows = np.arange(len(whole.triangles))
    edges, _ = yield from within(solid_edges(whole), 0.0, 0.5)
    if not edges.crowded:
        return BareMesh(whole, whole, rows)
    found = yield from within(_same_triangles(whole), 0.5, 0.6)
    kept = found == rows
    mesh = whole
    if not kept.all():
        mesh = _some(whole, kept)
        rows = (np.cumsum(kept) - 1)[found]
    walls = yield from within(inner_walls(mesh), 0.6, 1.0)
    if walls.any():
        mesh = _some(mesh, ~walls)
        rows = np.where(walls, -1, np.cumsum(~walls) - 1)[rows]
    return BareMesh(whole, mesh, rows)


def _some(mesh: TriangleMesh, kept: BoolArray) -> TriangleMesh:
    """Return some triangles of a mesh, with its vertices and numbers of polygons."""
    return replace(mesh, triangles=mesh.triangles[kept], polygons=mesh.polygons[kept])


def _same_triangles(mesh: TriangleMesh) -> Steps[IntArray]:
    """Return the first triangle with the corners and the winding of each, (T,)."""
    places = mesh.welded_triangles
    n_places = int(places.max()) + 1
    key, last = np.empty((2, len(places)), dtype=np.int64)
    for some in blocks(len(places)):
        yield Progress("Surface", 0.2 * some.start / len(places))
        # Let each triangle begin at its smallest corner. This keeps its winding.
        columns = (places[some].argmin(axis=1)[:, None] + [0, 1, 2]) % 3
        first, second, last[some] = np.take_along_axis(places[some], columns, axis=1).T
        key[some] = first.astype(np.int64) * n_places + second
    order = yield from beside(lambda: np.lexsort((last, key)), Progress("Surface", 0.2))
    key, last = key[order], last[order]
    yield Progress("Surface", 0.6)
    new = np.ones(len(order), dtype=bool)
    new[1:] = (key[1:] != key[:-1]) | (last[1:] != last[:-1])
    yield Progress("Surface", 0.8)
    found = np.empty(len(order), dtype=np.int64)
    found[order] = order[new][np.cumsum(new) - 1]
    return found
