"""The oracle for rays: every ray against every triangle, in NumPy."""

import numpy as np

# Pairs of a ray and a triangle at a time. Their arrays fit into the processor's cache.
_BLOCK = 1 << 17


class BruteCaster:
    """A `RayCaster` by Möller and Trumbore, "Fast, Minimum Storage Ray-Triangle
    Intersection", 1997, without culling.

    Their triple products are linear in the direction of a ray and its moment, so that
    they are products of matrices.
    """

    def __init__(self, mesh):
        corners = mesh.vertices[mesh.triangles]
        corner = corners[:, 0]
        first, second = corners[:, 1] - corner, corners[:, 2] - corner
        self._normals = np.cross(first, second)
        self._heights = (corner * self._normals).sum(axis=1)
        self._u = np.hstack([np.cross(corner, second), second])
        self._v = np.hstack([np.cross(first, corner), -first])

    def first_hit(self, origins, directions, reach):
        rows = max(1, _BLOCK // len(self._normals))
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
        rays = np.hstack([directions, np.cross(origins, directions)])
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = -1.0 / (directions @ self._normals.T)
            u, v = rays @ self._u.T * inverse, rays @ self._v.T * inverse
            along = (origins @ self._normals.T - self._heights) * inverse
            hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (along >= 0)
        return np.where(hit, along, np.inf)


class WatchedCaster(BruteCaster):
    """Counts how often rays are asked for, of all casters together."""

    calls = 0

    def first_hit(self, origins, directions, reach):
        WatchedCaster.calls += 1
        return super().first_hit(origins, directions, reach)


def are_cast(work):
    """Do some work, and return whether a `WatchedCaster` was asked for rays."""
    before = WatchedCaster.calls
    work()
    return WatchedCaster.calls > before
