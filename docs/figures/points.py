"""Point clouds of the figures: points spread over meshes, all of them or as scanned."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import bpy
import numpy as np
from shapes import added

# From places and normals, (N, 3), to which points stay, (N,) bool.
Keep: TypeAlias = Callable[[np.ndarray, np.ndarray], np.ndarray]


def sampled(
    obj: bpy.types.Object, n_points: int, keep: Keep | None = None
) -> bpy.types.Object:
    """Return points with normals, spread evenly over a mesh by its area.

    Parameters
    ----------
    keep : callable, optional
        From places and normals, (N, 3), to which points stay, (N,) bool.
    """
    obj.data.calc_loop_triangles()
    corners = np.array([v.co for v in obj.data.vertices])
    corners = corners[[t.vertices[:] for t in obj.data.loop_triangles]]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    doubled = np.linalg.norm(across, axis=1)
    rng = np.random.default_rng(0)
    chosen = np.searchsorted(
        doubled.cumsum() / doubled.sum(),
        (np.arange(n_points) + rng.random(n_points)) / n_points,
    )
    weights = rng.dirichlet(np.ones(3), n_points)[:, :, None]
    places = (corners[chosen] * weights).sum(axis=1)
    normals = across[chosen] / doubled[chosen, None]
    if keep is not None:
        kept = keep(places, normals)
        places, normals = places[kept], normals[kept]
    mesh = bpy.data.meshes.new("Cloud")
    mesh.from_pydata(places, [], [])
    layer = mesh.attributes.new("normal", "FLOAT_VECTOR", "POINT")
    layer.data.foreach_set("vector", normals.astype(np.float32).ravel())
    return added(mesh)


def seen_by_scanner(obj: bpy.types.Object, towards: np.ndarray) -> Keep:
    """Return what tells which places a scanner far away sees."""

    def keep(places: np.ndarray, normals: np.ndarray) -> np.ndarray:
        facing = normals @ towards > 0.15
        for i in np.flatnonzero(facing):
            start = places[i] + normals[i] * 1e-3
            facing[i] = not obj.ray_cast(start, towards)[0]
        return facing

    return keep
