"""Rays through the inside of a mesh.

Inside a closed shape is where the count of closed shells around a point is positive: a
ray that meets a front-facing triangle enters one more shell, at a back-facing one it
leaves one, and it leaves the inside where the count reaches zero. Interpenetrating
shells are thus seen through. An open shell has no inside to count: it ends the rays
that no closed shell is around, as in the paper, and is passed by the others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..geometry.mesh import TriangleMesh

# A ray goes on this far behind a triangle that it passes, in diagonals.
PASS = 1e-6
# Shells a ray passes at most, so that no stack of faces holds it up for ever.
_MOST_CROSSINGS = 64
# Surfaces behind the first one that are looked for along a ray, at most.
_MOST_BEHIND = 8
# What a ray meets so near its ends is the grain of the surface there, in grains.
_GRAINS_AT_ENDS = 2.0


class RayCaster(Protocol):
    """Anything that finds the first triangle along rays."""

    def first_hit(
        self,
        origins: NDArray[np.float64],
        directions: NDArray[np.float64],
        reach: NDArray[np.float64],
    ) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Return the nearest triangle along each ray, and its distance.

        Parameters
        ----------
        origins : (M, 3) float
            Starts of the rays, in the space of the mesh.
        directions : (M, 3) float
            Unit vectors.
        reach : (M,) float
            Hits farther than this are misses.

        Returns
        -------
        triangles : (M,) int
            Row of the mesh's triangles, −1 for a miss.
        distances : (M,) float
            `inf` for a miss.
        """
        ...


MakeCaster = Callable[[TriangleMesh], RayCaster]


class RayMarcher:
    """Sends rays through the inside of a mesh.

    Parameters
    ----------
    mesh : TriangleMesh
        Its normals point out of the inside.
    make_caster : callable
        Returns a `RayCaster` for `mesh`.
    closed : (T,) bool, optional
        Which triangles are of closed shells. None are if left out.
    grain : float, optional
        Size of the splats that `mesh` consists of, 0 for a true surface.
    tilt : float, optional
        Sine of the angle by which normals of `mesh` may be off.
    """

    def __init__(
        self,
        mesh: TriangleMesh,
        make_caster: MakeCaster,
        closed: NDArray[np.bool_] | None = None,
        grain: float = 0.0,
        tilt: float = 0.0,
    ) -> None:
        self.mesh = mesh
        self.normals = mesh.normals
        self.closed = np.zeros(len(mesh.triangles), bool) if closed is None else closed
        self.area = float(mesh.areas.sum())
        self.diagonal = mesh.diagonal
        self.grain = grain
        self.tilt = tilt
        self._make_caster = make_caster

    @cached_property
    def caster(self) -> RayCaster:
        """The ray tree, built when it is first asked for: hulls cast no rays."""
        return self._make_caster(self.mesh)

    def march(
        self,
        origins: NDArray[np.float64],
        directions: NDArray[np.float64],
        reach: NDArray[np.float64],
        depths: NDArray[np.int64],
    ) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]:
        """Follow rays until they leave the inside, and tell where.

        Parameters
        ----------
        origins, directions : (M, 3) float
            Starts inside, and unit vectors.
        reach : (M,) float
            How far the rays go at most.
        depths : (M,) int
            Number of closed shells around each origin.

        Returns
        -------
        exits : (M,) int
            Triangle through which the ray left, −1 if it did not.
        distances : (M,) float
            Of the exit, `inf` without one.
        depths : (M,) int
            Number of closed shells around the end.
        """
        n_rays = len(origins)
        exits, distances = np.full(n_rays, -1), np.full(n_rays, np.inf)
        skipped = np.minimum(_GRAINS_AT_ENDS * self.grain, reach / 3)
        reach = reach - skipped
        travelled, depths = skipped, depths.copy()
        going = np.arange(n_rays)
        for _ in range(_MOST_CROSSINGS):
            starts = origins[going] + travelled[going, None] * directions[going]
            triangles, lengths = self.caster.first_hit(
                starts, directions[going], reach[going] - travelled[going]
            )
            met = triangles >= 0
            going, triangles, lengths = going[met], triangles[met], lengths[met]
            facing = np.einsum("md,md->m", self.normals[triangles], directions[going])
            crossings = np.sign(facing).astype(np.int64) * self.closed[triangles]
            depths[going] -= crossings
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

    def surfaces_along(
        self,
        origins: NDArray[np.float64],
        directions: NDArray[np.float64],
        depths: NDArray[np.int64],
    ) -> Iterator[tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]]:
        """Follow rays out of the inside, then in and out again, to the end.

        Parameters
        ----------
        origins, directions : (M, 3) float
            Starts inside, and unit vectors.
        depths : (M,) int
            Number of closed shells around each origin.

        Yields
        ------
        rays : (H,) int
            Those that leave the inside once more.
        points : (H, 3) float
            Where.
        triangles : (H,) int
            Through which.
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
        self, origins: NDArray[np.float64], directions: NDArray[np.float64]
    ) -> NDArray[np.int64]:
        """Count the closed shells around points by how often rays leave them.

        Parameters
        ----------
        origins, directions : (M, 3) float

        Returns
        -------
        counts : (M,) int
            Negative where a ray comes in through a hole.
        """
        if not self.closed.any():
            return np.zeros(len(origins), dtype=np.int64)
        far = np.full(len(origins), 2 * self.diagonal)
        # Started so deep that no ray ends before the last crossing.
        bottom = np.full(len(origins), _MOST_CROSSINGS + 1)
        _, _, depths = self.march(origins, directions, far, bottom)
        return bottom - depths
