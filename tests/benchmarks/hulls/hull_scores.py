"""How well hulls stand for a solid, by the same code for every tool."""

import numpy as np
import trimesh
from scipy.spatial import ConvexHull, QhullError, cKDTree

_POINTS = 60_000
_ON_SURFACE = 20_000
_ON_HULL = 1000
# Rays from a place, forwards and back; most tell whether it is inside, though open
# meshes mislead some.
_RAYS = np.array([[0.31, 0.17, 1], [1, 0.23, -0.41], [-0.37, 1, 0.19]])
# What of the surface counts as within a hull: tools remesh and round a little.
_WITHIN = 0.01


def scores(mesh, hulls):
    """Return the figures of hulls (lists of points) of a trimesh.

    Units are CoACD's: half of the longest side of the shape is 1. The concavity of a
    hull is that of the piece of the solid within it (Wei et al. 2022): the larger of
    R_v, from the volume that the hull adds, and the Hausdorff distance between the
    surfaces of piece and hull; faces cut are where the hull's surface is inside.
    """
    low, high = mesh.bounds
    center, unit = (low + high) / 2, (high - low).max() / 2
    mesh = trimesh.Trimesh((mesh.vertices - center) / unit, mesh.faces, process=False)
    hulls = [_hull((points - center) / unit) for points in hulls]
    low = np.min([mesh.bounds[0], *(hull.min_bound for hull in hulls)], axis=0)
    high = np.max([mesh.bounds[1], *(hull.max_bound for hull in hulls)], axis=0)
    points = low + (high - low) * np.random.default_rng(1).random((_POINTS, 3))
    inside = _is_inside(mesh, points)
    cell = np.prod(high - low) / _POINTS
    surface = trimesh.sample.sample_surface(mesh, _ON_SURFACE, seed=1)[0]
    covered = np.zeros(_POINTS, dtype=bool)
    concavities = []
    for hull in hulls:
        within = _heights(hull, points) <= 0
        covered |= within
        concavities.append(
            _concavity(mesh, hull, surface, (inside & within).sum() * cell)
        )
    return {
        "hulls": len(hulls),
        "concavity": max(concavities),
        "mean": np.mean(concavities),
        "iou": (covered & inside).sum() / (covered | inside).sum(),
        "volumes": sum(hull.volume for hull in hulls) / (inside.sum() * cell),
    }


def _is_inside(mesh, points):
    """Return which points (M, 3) more surfaces are left from than entered, (M,)."""
    votes = np.zeros(len(points))
    for direction in np.concatenate([_RAYS, -_RAYS]):
        triangles, rays, _ = mesh.ray.intersects_id(
            points, np.tile(direction, (len(points), 1)), True, return_locations=True
        )
        leaves = np.sign(mesh.face_normals[triangles] @ direction)
        votes += np.bincount(rays, leaves, len(points)) > 0
    return votes > len(_RAYS)


def _hull(points):
    try:
        return ConvexHull(points)
    except QhullError:
        return ConvexHull(points, qhull_options="QJ")


def _heights(hull, points):
    return (points @ hull.equations[:, :3].T + hull.equations[:, 3]).max(axis=1)


def _concavity(mesh, hull, surface, volume):
    """Return the concavity of the piece of a solid within a hull."""
    heights = _heights(hull, surface)
    piece = surface[heights <= _WITHIN]
    volume_term = 0.3 * np.cbrt(3 * abs(hull.volume - volume) / (4 * np.pi))
    if len(piece) == 0:
        return volume_term
    corners = hull.points[hull.simplices]
    soup = trimesh.Trimesh(
        corners.reshape(-1, 3),
        np.arange(3 * len(corners)).reshape(-1, 3),
        process=False,
    )
    samples = trimesh.sample.sample_surface(soup, _ON_HULL, seed=2)[0]
    outside = samples[~_is_inside(mesh, samples)]
    away = cKDTree(piece).query(outside)[0].max(initial=0)
    return max(volume_term, away, -heights.min())
