"""The surface of solids that run into each other, without what is buried in others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.cutting.halving import edge_lengths, halved
from ...geometry.mesh import TriangleMesh
from ...solids.shells import Shells
from ...solids.volume import volumes_of
from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.progress import Progress, Steps
from ...steps.rows import blocks
from .fragments import reach_of
from .inside import InsideTest, inside_test
from .targets import Targets

# Longest edge of fragments that stay although they may be buried: they cross another
# solid's surface, or are close to it. The longest side of the whole is 2.
_GRAIN = 0.01
# Fragments no farther from a surface lie on it: they stay, and are cut no more.
_FLUSH = 1e-9
# Most triangles that are compared, counted once for each solid they are compared to.
_MOST_COMPARED = 100_000_000
# So many fragments are looked at, about; each solid has a share of them. What is not
# cut far enough then stays.
_MOST_LOOKS = 200_000
# Fragments that are looked at in one step.
_AT_ONCE = 500


@dataclass
class _Surface:
    """What is left of a surface.

    Attributes
    ----------
    pieces : (N, 3, 3) float
        Corners of whole triangles, and of fragments of others.
    rows : (N,) int
        Triangle that each is, or is a piece of.
    lost : (T,) bool
        Triangles that are buried, or that some piece is missing of.
    """

    pieces: FloatArray
    rows: IntArray
    lost: BoolArray

    def joined(self, mesh: TriangleMesh) -> tuple[TriangleMesh, IntArray]:
        """Return the whole triangles of the mesh, and the pieces of others."""
        cut = self.lost[self.rows]
        more, whole = self.pieces[cut], np.flatnonzero(~self.lost)
        vertices = np.concatenate([mesh.vertices, more.reshape(-1, 3)])
        triangles = len(mesh.vertices) + np.arange(3 * len(more)).reshape(-1, 3)
        triangles = np.concatenate([mesh.triangles[whole], triangles])
        rows = np.concatenate([whole, self.rows[cut]])
        return TriangleMesh(vertices, triangles, np.arange(len(rows))), rows

    def bury(self, solid: _Container, others: IntArray, most: int) -> Steps[int]:
        """Leave out what is inside a solid, of some of the pieces.

        Returns how many were looked at: once that are `most`, none is cut any more.
        """
        done, rows = [np.delete(self.pieces, others, axis=0)], self.rows[others]
        of_done, small = [np.delete(self.rows, others)], self.pieces[others]
        n_looked = 0
        while len(small):
            n_looked += len(small)
            centers, radii = reach_of(small)
            clear = yield from solid.is_clear_of(centers, radii)
            buried = clear.copy()
            buried[clear] = yield from solid.inside.which_held(centers[clear])
            self.lost[rows[buried]] = True
            lengths = edge_lengths(small)
            cut = ~clear & (lengths.max(axis=1) > _GRAIN) & (n_looked < most)
            cut[cut] = ~(yield from solid.has_on_it(small[cut]))
            stays = ~cut & ~buried
            done.append(small[stays])
            of_done.append(rows[stays])
            small, rows = halved(small[cut], lengths[cut]), np.tile(rows[cut], 2)
        self.pieces, self.rows = np.concatenate(done), np.concatenate(of_done)
        return n_looked


class _Container:
    """A solid, with the cavities near it, that others may be buried in."""

    def __init__(self, inside: InsideTest, targets: Targets) -> None:
        self.inside, self._targets = inside, targets

    def is_clear_of(self, centers: FloatArray, radii: FloatArray) -> Steps[BoolArray]:
        """Return which balls (M,) its surface does not meet."""
        clear = np.zeros(len(centers), dtype=bool)
        for some in blocks(len(centers), _AT_ONCE):
            yield Progress("Solid", 0.0)
            clear[some] = ~self._targets.are_within(centers[some], radii[some])
        return clear

    def has_on_it(self, pieces: FloatArray) -> Steps[BoolArray]:
        """Return which pieces (M,) have their corners and centers on its surface."""
        on_it, radii = np.ones(len(pieces), dtype=bool), np.full(len(pieces), _FLUSH)
        for points in (pieces.mean(axis=1), *pieces.swapaxes(0, 1)):
            on_it[on_it] = ~(yield from self.is_clear_of(points[on_it], radii[on_it]))
        return on_it


def unburied(
    mesh: TriangleMesh, shells: Shells
) -> Steps[tuple[TriangleMesh, IntArray]]:
    """Return the surface of a union of closed solids.

    What is inside one other solid is buried.

    Parameters
    ----------
    mesh : TriangleMesh
        Oriented, all its shells closed. Its longest side is 2.
    shells : Shells
        Its shells.

    Returns
    -------
    surface : TriangleMesh
        Whole triangles of `mesh` and pieces of others; `mesh` itself if nothing is
        buried, or if it would take long to tell. Pieces next to another surface stay.
    rows : (N,) int
        Triangle of `mesh` that each of its triangles is, or is a piece of.
    """
    corners, all_rows = mesh.vertices[mesh.triangles], np.arange(len(mesh.triangles))
    left = _Surface(corners, all_rows, np.zeros(len(corners), bool))
    boxes = np.stack(shells.bounds(mesh), axis=1)
    around = yield from _containers(mesh, shells, boxes)
    n_looks = _MOST_LOOKS
    for turn, (shell, own) in enumerate(around.items()):
        yield Progress("Solid", turn / len(around))
        others = shells.of_triangle[left.rows] != shell
        others &= _meeting(left.pieces, *boxes[shell])
        share = n_looks // (len(around) - turn)
        inside = yield from inside_test(corners[own], 1)
        yield Progress("Solid", turn / len(around))
        container = _Container(inside, Targets(corners[own]))
        n_looks -= yield from left.bury(container, np.flatnonzero(others), share)
    return left.joined(mesh) if left.lost.any() else (mesh, all_rows)


def _meeting(pieces: FloatArray, low: FloatArray, high: FloatArray) -> BoolArray:
    """Return whether the boxes around pieces (N, K, 3) meet another one, (N,)."""
    meets = np.ones(len(pieces), dtype=bool)
    for axis in range(3):
        along = pieces[..., axis]
        meets &= along.min(axis=1) < high[axis]
        meets &= along.max(axis=1) > low[axis]
    return meets


def _containers(
    mesh: TriangleMesh, shells: Shells, boxes: FloatArray
) -> Steps[dict[int, IntArray]]:
    """Return the triangles of solids whose boxes meet others, and of cavities there.

    They are those of a shell and of each cavity whose box (S, 2, 3) meets its own. None
    if there are so many that it would take long.
    """
    volumes, n_shells = (yield from volumes_of(mesh)), len(shells.closed)
    solid = np.bincount(shells.of_triangle, volumes, n_shells) > 0
    if np.count_nonzero(solid) * len(mesh.triangles) > _MOST_COMPARED:
        return {}
    found: dict[int, IntArray] = {}
    for shell in np.flatnonzero(solid).tolist():
        meets = _meeting(boxes, *boxes[shell])
        meets[shell] = False
        if meets.any():
            own = [shell, *np.flatnonzero(meets & ~solid)]
            found[shell] = np.concatenate([shells.members[each] for each in own])
    return found
