"""What casts rays: the protocol, and several ray trees for one large mesh."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import DecompositionError
from ..geometry.array_checks import real_numbers
from ..geometry.mesh import TriangleMesh
from ..steps.arrays import FloatArray, IntArray
from ..steps.progress import Progress, Steps

# Triangles in a tree: Blender takes 0.06 s for it. Smaller trees take less, but rays
# longer: a quarter more for a million triangles in eleven trees, not six.
_IN_A_TREE = 100_000
# Most trees: rays ask all of them. With more triangles, there are more in each tree; of
# ten million, a tree takes 0.2 s.
_MOST_TREES = 32


class RayCaster(Protocol):
    """An object that finds the first triangle along rays."""

    def first_hit(
        self, origins: FloatArray, directions: FloatArray, reach: FloatArray
    ) -> tuple[IntArray, FloatArray]:
        """Return the nearest triangle along each ray and its distance.

        Parameters
        ----------
        origins : (M, 3) float
            Starts of the rays, in the space of the mesh.
        directions : (M, 3) float
            Unit vectors.
        reach : (M,) float
            Triangles farther away than this are not hit.

        Returns
        -------
        triangles : (M,) int
            Row of the mesh's triangles, −1 for a miss.
        distances : (M,) float
            Distance from the origin, `inf` for a miss.
        """
        ...


MakeCaster = Callable[[TriangleMesh], RayCaster]


def caster_in_steps(mesh: TriangleMesh, make_caster: MakeCaster) -> Steps[RayCaster]:
    """Make a ray caster for a mesh, in several steps if it is large.

    Parameters
    ----------
    mesh : TriangleMesh
    make_caster : callable
        Returns a `RayCaster` for a `TriangleMesh`.

    Returns
    -------
    Steps of RayCaster
        It hits what one caster for the whole mesh hits. Answers of what
        `make_caster` made may be lists; a `DecompositionError` is raised if they are
        no hits.
    """
    yield Progress("Ray tree", 0.0)
    n_triangles = len(mesh.triangles)
    n_trees = min(-(-n_triangles // _IN_A_TREE), _MOST_TREES)
    if n_trees == 1:
        return _Trees([(np.arange(n_triangles), make_caster(mesh))])
    # Slices along the longest axis: most rays miss most of them.
    low, high = mesh.bounds
    along = mesh.vertices[mesh.triangles[:, 0], (high - low).argmax()]
    bounds = np.arange(1, n_trees) * n_triangles // n_trees
    order = np.argpartition(along, bounds)
    trees = []
    for number, rows in enumerate(np.split(order, bounds)):
        yield Progress("Ray tree", number / n_trees)
        rows.sort()
        part = _slice(mesh, rows)
        yield Progress("Ray tree", (number + 0.3) / n_trees)
        trees.append((rows, make_caster(part)))
    return _Trees(trees)


def _slice(mesh: TriangleMesh, rows: IntArray) -> TriangleMesh:
    """Return some triangles of a mesh, and the vertices that they use."""
    triangles = mesh.triangles[rows]
    used = np.zeros(len(mesh.vertices), dtype=bool)
    used[triangles.ravel()] = True
    places = np.cumsum(used) - 1
    return TriangleMesh(mesh.vertices[used], places[triangles], np.arange(len(rows)))


class _Trees:
    """Casts each ray at one or several trees, and takes the nearest hit."""

    def __init__(self, trees: Sequence[tuple[IntArray, RayCaster]]) -> None:
        self._trees = trees

    def first_hit(
        self, origins: FloatArray, directions: FloatArray, reach: FloatArray
    ) -> tuple[IntArray, FloatArray]:
        """Return what the protocol says; triangles are those of the whole mesh."""
        triangles = np.full(len(origins), -1)
        distances = np.full(len(origins), np.inf)
        for rows, caster in self._trees:
            nearest = np.minimum(reach, distances)
            rays = origins, directions, nearest
            hits, lengths = _checked_hits(caster, len(rows), *rays)
            nearer = (hits >= 0) & (lengths < distances)
            triangles[nearer] = rows[hits[nearer]]
            distances[nearer] = lengths[nearer]
        return triangles, distances


def _checked_hits(
    caster: RayCaster, n_triangles: int, *rays: FloatArray
) -> tuple[IntArray, FloatArray]:
    """Ask a ray caster, and check what it answers: scripts may bring their own."""
    found = caster.first_hit(*rays)
    if isinstance(found, Sequence) and len(found) == 2:
        triangles, distances = (real_numbers(each) for each in found)
        if (
            triangles is not None
            and distances is not None
            and _fit(triangles, distances, len(rays[0]), n_triangles)
        ):
            return triangles.astype(np.int64, copy=False), distances
    raise DecompositionError(
        "The ray caster answers with something else than two arrays of one number for"
        f" each ray: a triangle below {n_triangles}, or -1 for a miss, and a finite"
        " distance; correct its method `first_hit`."
    )


def _fit(
    triangles: NDArray[Any], distances: NDArray[Any], n_rays: int, n_triangles: int
) -> bool:
    """Return whether arrays are triangles and distances of rays."""
    if triangles.size and triangles.dtype.kind == "f":
        return False
    if not triangles.shape == distances.shape == (n_rays,):
        return False
    lengths = distances[triangles >= 0]
    far = np.isfinite(lengths) & (lengths >= 0)
    return bool((triangles < n_triangles).all() and far.all())
