"""Shapes that take long: of many shells, or of as many faces as are asked for."""

import numpy as np
import shapes
from weak_convex_decomposition import TriangleMesh


def building(n_shells=72, divisions=3, around=24, seed=0):
    """Beams, floors and pipes that run through each other: boxes and tubes."""
    rng = np.random.default_rng(seed)
    pieces = []
    for number in range(n_shells):
        low = rng.uniform(0.0, 0.7, 3)
        size = rng.uniform(0.05, 0.2, 3)
        size[number % 3] = rng.uniform(0.4, 1.0)
        if number % 2:
            pieces.append(shapes.box(low, low + size, divisions))
        else:
            pieces.append(pipe(low, low + size, number % 3, around))
    return shapes.joined(*pieces)


def pipe(low, high, axis, around):
    """A round bar along an axis, between two corners."""
    bar = shapes.turned([0.0, 0.5, 0.5, 0.0], [0.0, 0.0, 1.0, 1.0], around)
    vertices = np.roll(bar.vertices + np.array((0.5, 0.5, 0.0)), axis + 1, axis=1)
    return shapes.mesh_of(low + vertices * (high - low), bar.triangles)


def loose_pieces(n_pieces=2000, seed=0):
    """Small boxes that are scattered over a cube."""
    rng = np.random.default_rng(seed)
    lows = rng.uniform(0.0, 1.0, (n_pieces, 3))
    sizes = rng.uniform(0.01, 0.04, (n_pieces, 3))
    return shapes.joined(
        *(shapes.box(low, low + size) for low, size in zip(lows, sizes, strict=True))
    )


def nested_spheres(n_spheres=20, subdivisions=3):
    """Spheres around the same center, all with their normals outwards."""
    radii = np.linspace(1.0, 0.1, n_spheres)
    return shapes.joined(*(shapes.sphere(subdivisions, radius) for radius in radii))


def copies(mesh, n_copies=2):
    """The same surface several times."""
    return shapes.joined(*[mesh] * n_copies)


def with_doubled_faces(mesh):
    """Every triangle twice, on the same vertices."""
    return shapes.mesh_of(mesh.vertices, np.vstack([mesh.triangles] * 2))


def slabs(n_slabs=20, thickness=1e-4):
    """Thin plates in a stack, crossed by as many others."""
    pieces = []
    for height in np.linspace(0.0, 1.0, n_slabs):
        for axis in (0, 2):
            low, high = np.zeros(3), np.ones(3)
            low[axis], high[axis] = height, height + thickness
            pieces.append(shapes.box(low, high))
    return shapes.joined(*pieces)


def lumpy_ring(n_triangles: int) -> TriangleMesh:
    """Return a lumpy ring of quads with about so many triangles."""
    n_across = int(np.sqrt(n_triangles / 8))
    n_along = 4 * n_across
    along, across = np.meshgrid(
        2 * np.pi * np.arange(n_along) / n_along,
        2 * np.pi * np.arange(n_across) / n_across,
        indexing="ij",
    )
    radii = 0.4 + 0.15 * np.sin(5 * along) + 0.05 * np.sin(3 * across + along)
    reach = 1 + radii * np.cos(across)
    points = np.stack(
        [reach * np.cos(along), reach * np.sin(along), radii * np.sin(across)], axis=-1
    )
    a = np.arange(n_along * n_across).reshape(n_along, n_across)
    b, d = np.roll(a, -1, axis=0), np.roll(a, -1, axis=1)
    quads = np.stack([a, b, np.roll(b, -1, axis=1), d], axis=-1).reshape(-1, 4)
    triangles = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    return TriangleMesh(
        points.reshape(-1, 3), triangles, np.repeat(np.arange(len(quads)), 2)
    )
