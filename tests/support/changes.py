"""Changes of meshes for tests: moved, shuffled, refined, cut."""

from dataclasses import replace

import numpy as np
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh


def inside_out(mesh):
    """Return the mesh with every triangle turned."""
    return replace(mesh, triangles=mesh.triangles[:, ::-1])


def split(mesh):
    """Return the mesh with vertices of its own for each triangle, as in an STL."""
    return replace(
        mesh,
        vertices=mesh.vertices[mesh.triangles.ravel()],
        triangles=np.arange(mesh.triangles.size).reshape(-1, 3),
    )


def refined(mesh):
    """Return the mesh with each triangle in four; polygons stay what they are."""
    edges = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, middles = np.unique(edges, axis=0, return_inverse=True)
    ab, bc, ca = (middles.reshape(-1, 3) + len(mesh.vertices)).T
    a, b, c = mesh.triangles.T
    quarters = [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    return TriangleMesh(
        np.concatenate([mesh.vertices, mesh.vertices[edges].mean(axis=1)]),
        np.stack(quarters).transpose(2, 0, 1).reshape(-1, 3),
        np.repeat(mesh.polygons, 4),
    )


def without(mesh, chosen):
    """Return the mesh without triangles of which `chosen(centers)` is true."""
    keep = ~chosen(mesh.vertices[mesh.triangles].mean(axis=1))
    _, polygons = np.unique(mesh.polygons[keep], return_inverse=True)
    return replace(mesh, triangles=mesh.triangles[keep], polygons=polygons)


def moved(mesh, scale=1.0, rotation=None, offset=(0, 0, 0)):
    """Return the mesh scaled, rotated and set off."""
    rotation = np.eye(3) if rotation is None else rotation
    return replace(mesh, vertices=scale * mesh.vertices @ rotation.T + offset)


def any_rotation(seed):
    """Return a random rotation matrix."""
    matrix, triangular = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    matrix = matrix * np.sign(np.diag(triangular))
    return matrix * np.linalg.det(matrix)


def permuted(mesh, seed):
    """Return the mesh with vertices and polygons shuffled, and each one's new row."""
    rng = np.random.default_rng(seed)
    vertices = rng.permutation(len(mesh.vertices))
    polygons = rng.permutation(mesh.n_polygons)
    order = np.argsort(polygons[mesh.polygons], kind="stable")
    shuffled = TriangleMesh(
        mesh.vertices[np.argsort(vertices)],
        vertices[mesh.triangles[order]],
        polygons[mesh.polygons[order]],
    )
    return shuffled, polygons
