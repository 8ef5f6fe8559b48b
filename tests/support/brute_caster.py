"""The oracle for rays: every ray against every triangle, in NumPy."""

import numpy as np

# Pairs of a ray and a triangle at a time. Their arrays fit into the processor's cache.
_BLOCK = 1 << 15


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
        normals = np.cross(first, second)
        self._heights = (corner * normals).sum(axis=1)
        u = np.hstack([np.cross(corner, second), second])
        v = np.hstack([np.cross(first, corner), -first])
        # A triangle is a column. Products are quicker if rows are in one piece.
        self._normals, self._u, self._v = map(_transposed, (normals, u, v))

    def first_hit(self, origins, directions, reach):
        rows = max(1, _BLOCK // len(self._heights))
        triangles = np.full(len(origins), -1, dtype=np.int64)
        distances = np.full(len(origins), np.inf)
        for start in range(0, len(origins), rows):
            block = slice(start, start + rows)
            ray, triangle, along = self._hits(origins[block], directions[block])
            ray += start
            near = np.flatnonzero((along >= 0) & (along <= reach[ray]))
            near = near[np.lexsort((along[near], ray[near]))]
            hit, first = np.unique(ray[near], return_index=True)
            triangles[hit], distances[hit] = triangle[near][first], along[near][first]
        return triangles, distances

    def _hits(self, origins, directions):
        """Return the pairs of a ray and a triangle on its line, and how far it is."""
        rays = np.hstack([directions, np.cross(origins, directions)])
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = -1.0 / (directions @ self._normals)
            u, v = rays @ self._u, rays @ self._v
            u *= inverse
            v *= inverse
            hit = (u >= 0) & (v >= 0)
            u += v
            hit &= u <= 1
            ray, triangle = np.divmod(np.flatnonzero(hit), hit.shape[1])
            heights = (origins @ self._normals)[ray, triangle] - self._heights[triangle]
            return ray, triangle, heights * inverse[ray, triangle]


def _transposed(array):
    return np.ascontiguousarray(array.T)


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
