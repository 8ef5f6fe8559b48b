"""The oracle for rays: every ray against every triangle, in NumPy."""

import numpy as np

_BLOCK = 1 << 20  # pairs of a ray and a triangle at a time


class BruteCaster:
    """A `RayCaster` by Möller and Trumbore, "Fast, Minimum Storage Ray-Triangle
    Intersection", 1997, without culling.
    """

    def __init__(self, mesh):
        corners = mesh.vertices[mesh.triangles]
        self._corner = corners[:, 0]
        self._edges = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]

    def first_hit(self, origins, directions, reach):
        rows = max(1, _BLOCK // len(self._corner))
        triangles = np.full(len(origins), -1, dtype=np.int64)
        distances = np.full(len(origins), np.inf)
        for start in range(0, len(origins), rows):
            block = slice(start, start + rows)
            along = self._distances(origins[block], directions[block])
            along[along > reach[block, None]] = np.inf
            nearest = along.argmin(axis=1)
            distance = along[np.arange(len(along)), nearest]
            triangles[block] = np.where(np.isfinite(distance), nearest, -1)
            distances[block] = distance
        return triangles, distances

    def _distances(self, origins, directions):
        """Return the distance (M, T) along each ray to each triangle, inf for none."""
        first, second = self._edges
        normal = np.cross(directions[:, None], second)
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = 1.0 / (first * normal).sum(axis=-1)
            offset = origins[:, None] - self._corner
            u = (offset * normal).sum(axis=-1) * inverse
            across = np.cross(offset, first)
            v = (directions[:, None] * across).sum(axis=-1) * inverse
            along = (second * across).sum(axis=-1) * inverse
            hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (along >= 0)
        return np.where(hit, along, np.inf)
