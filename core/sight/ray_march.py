"""Rays through the inside of a mesh.

A point is inside when at least one closed shell is around it. A ray that hits a
front-facing triangle enters one more shell; at a back-facing triangle it leaves one. It
leaves the inside where the count of shells falls to zero, so rays pass from one shell
into another where the two overlap. An open shell has no inside. Outside of all closed
shells it ends a ray, as in the paper; within a closed shell, rays pass through it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..geometry.mesh import TriangleMesh
from ..steps.arrays import BoolArray, FloatArray, IntArray
from ..steps.memo import computed_once
from ..steps.progress import Steps, run
from .ray_caster import MakeCaster, RayCaster, caster_in_steps

# Rays between two reports of progress, about 20 ms.
RAYS_PER_STEP = 4096
# Rays are cast anew behind each triangle that they pass: at most so many in a step.
MOST_CASTS = 2 * RAYS_PER_STEP
# Rows of the first step of all, which tells how many casts a row takes.
_FIRST_ROWS = 64
# A ray continues this far behind a triangle that it passes, in diagonals.
PASS = 1e-6
# Most triangles that a ray passes, so that a stack of faces cannot hold it up forever.
_MOST_CROSSINGS = 64
# Most surfaces behind the first one that are searched for along a ray.
_MOST_BEHIND = 8
# Splats this close to the ends of a ray are ignored, in sizes of a splat: they are the
# uneven surface around the ends.
_SPLATS_AT_ENDS = 2.0


class RayMarcher:
    """Follows rays through the inside of a mesh.

    Parameters
    ----------
    mesh : TriangleMesh
        Its normals point outwards.
    make_caster : callable
        Returns a `RayCaster` for `mesh`.
    closed : (T,) bool, optional
        Which triangles belong to closed shells. By default none do.
    splat_size : float, optional
        Size of the splats of a point cloud, 0 for a mesh with faces.
    tilt : float, optional
        Sine of the largest error of the normals.

    Attributes
    ----------
    normals : (T, 3) float
        Outward unit normals of the triangles.
    diagonal : float
        Diagonal of the bounding box of `mesh`.
    n_cast : int
        Number of rays that were cast: `march` casts one for each surface that it meets.
    """

    def __init__(
        self,
        mesh: TriangleMesh,
        make_caster: MakeCaster,
        closed: BoolArray | None = None,
        splat_size: float = 0.0,
        tilt: float = 0.0,
    ) -> None:
        self.mesh = mesh
        self.normals = mesh.normals
        self.closed = np.zeros(len(mesh.triangles), bool) if closed is None else closed
        self.diagonal = mesh.diagonal
        self.splat_size = splat_size
        self.tilt = tilt
        self.n_cast = 0
        self._make_caster = make_caster

    @property
    def caster(self) -> RayCaster:
        """The ray tree of `mesh`, built on first use because hulls cast no rays."""
        return run(self.caster_in_steps())

    @computed_once
    def caster_in_steps(self) -> Steps[RayCaster]:
        """Return `caster`, made in steps if it is not there yet."""
        return (yield from caster_in_steps(self.mesh, self._make_caster))

    def march(
        self,
        origins: FloatArray,
        directions: FloatArray,
        reach: FloatArray,
        depths: IntArray,
    ) -> tuple[IntArray, FloatArray, IntArray]:
        """Find the points where rays leave the inside for the first time.

        Parameters
        ----------
        origins, directions : (M, 3) float
            Starts of the rays, inside, and unit vectors.
        reach : (M,) float
            Largest distance that each ray goes.
        depths : (M,) int
            Number of closed shells around each origin.

        Returns
        -------
        exits : (M,) int
            Triangle through which the ray leaves, −1 if it stays inside, or still goes
            on after it has passed 64 triangles.
        distances : (M,) float
            Distance to the exit, `inf` without one.
        depths : (M,) int
            Number of closed shells around the end of the ray.
        """
        going = np.arange(len(origins))
        exits, distances = np.full(len(going), -1), np.full(len(going), np.inf)
        skipped = np.minimum(_SPLATS_AT_ENDS * self.splat_size, reach / 3)
        reach, travelled, depths = reach - skipped, skipped, depths.copy()
        for _ in range(_MOST_CROSSINGS):
            ahead, gone = directions[going], travelled[going]
            starts = origins[going] + gone[:, None] * ahead
            triangles, lengths = self.first_hit(starts, ahead, reach[going] - gone)
            met = triangles >= 0
            going, triangles, lengths = going[met], triangles[met], lengths[met]
            facing = np.einsum("md,md->m", self.normals[triangles], ahead[met])
            depths[going] -= np.sign(facing).astype(np.int64) * self.closed[triangles]
            travelled[going] += lengths
            left = depths[going] <= 0
            exits[going[left]] = triangles[left]
            distances[going[left]] = travelled[going[left]]
            going = going[~left]
            travelled[going] += PASS * self.diagonal
            going = going[travelled[going] < reach[going]]
            if len(going) == 0:
                break
        return exits, distances, depths

    def first_hit(self, *rays: FloatArray) -> tuple[IntArray, FloatArray]:
        """Cast rays, as `RayCaster.first_hit` does, and count them."""
        self.n_cast += len(rays[0])
        return self.caster.first_hit(*rays)

    def in_turns(self, n_rows: int) -> Iterator[slice]:
        """Yield slices of rows, each a step's worth of work.

        Parameters
        ----------
        n_rows : int
            Each takes some rays: what is cast for one slice tells how long the next is.
        """
        start, size = 0, _FIRST_ROWS
        while start < n_rows:
            stop, before = min(start + size, n_rows), self.n_cast
            yield slice(start, stop)
            n_cast = max(self.n_cast - before, 1)
            size = max(MOST_CASTS * (stop - start) // n_cast, 1)
            start = stop

    def surfaces_along(
        self, origins: FloatArray, directions: FloatArray, depths: IntArray
    ) -> Iterator[tuple[IntArray, FloatArray, IntArray]]:
        """Find all points where rays leave the inside, the nearest ones first.

        Parameters
        ----------
        origins : (M, 3) float
            Starts of the rays, inside.
        directions : (M, 3) float
            Unit vectors.
        depths : (M,) int
            Number of closed shells around each origin.

        Yields
        ------
        rays : (H,) int
            Rays that leave the inside once more.
        points : (H, 3) float
            Where each of them leaves.
        triangles : (H,) int
            Triangle that each of them leaves through.
        """
        rays, starts = np.arange(len(origins)), origins
        for _ in range(1 + _MOST_BEHIND):
            reach = np.full(len(rays), 2 * self.diagonal)
            triangles, distances, _ = self.march(
                starts, directions[rays], reach, depths
            )
            left = triangles >= 0
            rays, triangles = rays[left], triangles[left]
            if len(rays) == 0:
                return
            points = starts[left] + distances[left, None] * directions[rays]
            yield rays, points, triangles
            starts = points + PASS * self.diagonal * directions[rays]
            depths = np.zeros(len(rays), dtype=np.int64)

    def shells_around(
        self, points: FloatArray, directions: Sequence[FloatArray]
    ) -> IntArray:
        """Count the closed shells around points, by two or three rays from each.

        Parameters
        ----------
        points : (M, 3) float
        directions : sequence of (M, 3) float
            Unit vectors of three rays. The last ones are cast only where the counts of
            the others differ.

        Returns
        -------
        counts : (M,) int
            Exits of a ray minus its entries. The median ignores one ray that slips
            through between two triangles.
        """
        if not self.closed.any():
            return np.zeros(len(points), dtype=np.int64)
        # Start with so many shells that no ray ends before its last crossing.
        bottom = np.full(len(points), _MOST_CROSSINGS + 1)
        far = np.full(len(points), 2 * self.diagonal)

        def count(rows: IntArray, turn: int) -> IntArray:
            rays = points[rows], directions[turn][rows], far[rows], bottom[rows]
            return bottom[rows] - self.march(*rays)[2]

        every = np.arange(len(points))
        counts = np.array([count(every, turn) for turn in (0, 1)])
        differ = np.flatnonzero(counts[0] != counts[1])
        last = count(differ, 2)
        counts[0, differ] = np.median([*counts[:, differ], last], axis=0)
        return np.maximum(counts[0], 0)
