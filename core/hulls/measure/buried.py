"""The surface of solids that run into each other, without what is buried in others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...geometry.mesh import TriangleMesh
from ...geometry.sampling import Samples
from ...solids.shells import Shells
from ...solids.volume import volumes_of
from ...steps.progress import Progress, Steps
from .fragments import edge_lengths, halved, reach_of
from .inside import InsideTest
from .targets import Targets

# Longest edge of fragments that stay although they may be buried: they cross another
# solid's surface, or are close to it. The longest side of the whole is 2.
_GRAIN = 0.01
# Most triangles that are compared, counted once for each solid they are compared to.
_MOST_COMPARED = 4_000_000
# Most fragments of one solid. With more of them, none is cut any further.
_MOST_FRAGMENTS = 100_000


def unburied(
    mesh: TriangleMesh, shells: Shells, samples: Samples
) -> Steps[tuple[TriangleMesh, Samples]]:
    """Return the surface of a union of closed solids, and the samples on it.

    Parameters
    ----------
    mesh : TriangleMesh
        Oriented, all its shells closed. Its longest side is 2.
    shells : Shells
        Its shells.
    samples : Samples
        Samples of `mesh`.

    Returns
    -------
    surface : TriangleMesh
        Whole triangles of `mesh` and pieces of others; `mesh` itself if nothing is
        buried, or if it would take long to tell. Pieces next to another surface stay.
    samples : Samples
        Those that are not buried.
    """
    corners = mesh.vertices[mesh.triangles]
    around = yield from _others(mesh, shells)
    whole, pieces = np.ones(len(corners), dtype=bool), [corners[:0]]
    buried = np.zeros(len(samples), dtype=bool)
    of_sample = shells.of_triangle[samples.triangles]
    for turn, (shell, others) in enumerate(around.items()):
        yield Progress("Solid", turn / len(around))
        inside, targets = InsideTest(corners[others], 1), Targets(corners[others])
        rows = shells.members[shell]
        touched, kept = _outside(corners[rows], inside, targets)
        whole[rows[touched]] = False
        pieces.append(kept)
        mine = np.flatnonzero(of_sample == shell)
        buried[mine] = inside.holds(samples.positions[mine])
    if whole.all():
        return mesh, samples
    more = np.concatenate(pieces)
    vertices = np.concatenate([mesh.vertices, more.reshape(-1, 3)])
    triangles = len(mesh.vertices) + np.arange(3 * len(more)).reshape(-1, 3)
    triangles = np.concatenate([mesh.triangles[whole], triangles])
    surface = TriangleMesh(vertices, triangles, np.arange(len(triangles)))
    return surface, samples.at(np.flatnonzero(~buried))


def _others(mesh: TriangleMesh, shells: Shells) -> Steps[dict[int, NDArray[np.int64]]]:
    """Return the triangles of all shells whose boxes meet that of each solid, if any.

    Walls of cavities are no solids: they are never buried. None if there are too many.
    """
    volumes, n_shells = (yield from volumes_of(mesh)), len(shells.closed)
    solid = np.bincount(shells.of_triangle, volumes, n_shells) > 0
    lows, highs = shells.bounds(mesh)
    found: dict[int, NDArray[np.int64]] = {}
    n_compared = 0
    for shell in np.flatnonzero(solid).tolist():
        meets = (lows <= highs[shell]).all(axis=1) & (highs >= lows[shell]).all(axis=1)
        meets[shell] = False
        if meets.any():
            found[shell] = np.flatnonzero(meets[shells.of_triangle])
            n_compared += len(found[shell])
        if n_compared > _MOST_COMPARED:
            return {}
    return found


def _outside(
    corners: NDArray[np.float64], inside: InsideTest, targets: Targets
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Return which triangles (T, 3, 3) are partly in other solids, and what is not.

    `inside` and `targets` are of these solids.

    The rest of those triangles is in pieces (N, 3, 3).
    """
    rows = np.arange(len(corners))
    touched, kept = np.zeros(len(corners), dtype=bool), []
    small = corners
    while len(small):
        centers, radii = reach_of(small)
        buried = inside.holds(centers)
        # Where no surface is near, all of a fragment is where its center is.
        clear = targets.nearest(centers) > radii
        touched[rows[clear & buried]] = True
        lengths = edge_lengths(small)
        ready = clear | (lengths.max(axis=1) <= _GRAIN)
        if len(small) > _MOST_FRAGMENTS:
            ready[:] = True
        stays = ready & ~(clear & buried)
        kept.append((rows[stays], small[stays]))
        small = halved(small[~ready], lengths[~ready])
        rows = np.tile(rows[~ready], 2)
    of, pieces = (np.concatenate(each) for each in zip(*kept, strict=True))
    return touched, pieces[touched[of]]
