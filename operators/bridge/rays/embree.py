"""Cast rays by Embree, without Blender: all in one call, many times faster."""

from __future__ import annotations

import numpy as np
from embreex.mesh_construction import TriangleMesh as EmbreeMesh
from embreex.rtcore_scene import EmbreeScene

from ....core.geometry.mesh import TriangleMesh
from ....core.steps.arrays import FloatArray, IntArray

# Triangle number that Embree returns for a ray without a hit.
_MISS = -1


class EmbreeRayCaster:
    """Cast rays at one mesh by Embree, in single precision.

    Implements the protocol `RayCaster` of `core.sight.ray_caster`.

    Parameters
    ----------
    mesh : TriangleMesh
        Hits are numbered by its triangles.
    """

    def __init__(self, mesh: TriangleMesh) -> None:
        # Robust: no ray passes between two triangles that share an edge.
        self._scene = EmbreeScene(robust=True)
        corners = np.ascontiguousarray(mesh.vertices[mesh.triangles], dtype=np.float32)
        EmbreeMesh(self._scene, corners)

    def first_hit(
        self, origins: FloatArray, directions: FloatArray, reach: FloatArray
    ) -> tuple[IntArray, FloatArray]:
        """Return the first triangle along each ray and its distance, as `RayCaster`."""
        rays = [
            np.ascontiguousarray(array, dtype=np.float32)
            for array in (origins, directions, reach)
        ]
        found = self._scene.run(*rays, output=1)
        triangles = found["primID"].astype(np.int64)
        distances = found["tfar"].astype(np.float64)
        missed = (triangles == _MISS) | (distances > reach)
        return np.where(missed, _MISS, triangles), np.where(missed, np.inf, distances)
