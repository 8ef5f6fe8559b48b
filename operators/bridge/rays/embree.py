"""Rays cast by Embree, where there is no Blender: in one call, many times faster."""

from __future__ import annotations

import numpy as np
from embreex.mesh_construction import TriangleMesh as EmbreeMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from ....core.geometry.mesh import TriangleMesh

# Number by which Embree says that a ray hits nothing.
_MISS = -1


class EmbreeRayCaster:
    """A `RayCaster` for one mesh; it works in single precision.

    Parameters
    ----------
    mesh : TriangleMesh
        Its triangles are numbered in the answers.
    """

    def __init__(self, mesh: TriangleMesh) -> None:
        # Robust: no ray slips through between two triangles of one edge.
        self._scene = EmbreeScene(robust=True)
        corners = np.ascontiguousarray(mesh.vertices[mesh.triangles], dtype=np.float32)
        EmbreeMesh(self._scene, corners)

    def first_hit(
        self,
        origins: NDArray[np.float64],
        directions: NDArray[np.float64],
        reach: NDArray[np.float64],
    ) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Return the nearest triangle along each ray, and its distance.

        See `core.sight.ray_march.RayCaster`.
        """
        rays = [
            np.ascontiguousarray(array, dtype=np.float32)
            for array in (origins, directions, reach)
        ]
        found = self._scene.run(*rays, output=1)
        triangles = found["primID"].astype(np.int64)
        distances = found["tfar"].astype(np.float64)
        missed = (triangles == _MISS) | (distances > reach)
        return np.where(missed, _MISS, triangles), np.where(missed, np.inf, distances)
