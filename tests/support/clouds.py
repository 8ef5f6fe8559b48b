"""Point clouds for tests: points drawn on meshes."""

import numpy as np
from weak_convex_decomposition.core.geometry.point_cloud import PointCloud
from weak_convex_decomposition.core.geometry.sampling import sample_surface


def drawn(mesh, n_points=800, noise=0.0, seed=0):
    """Return points and normals on a mesh; noise is in diagonals."""
    rng = np.random.default_rng(seed)
    samples = sample_surface(mesh, n_points, rng)
    jitter = noise * mesh.diagonal * rng.normal(size=(n_points, 3))
    return samples.positions + jitter, samples.normals


def changed(array, row, values):
    """Return a copy with other values in a row."""
    array = array.copy()
    array[row] = values
    return array


def cloud_of(mesh, n_points=800, noise=0.0, seed=0):
    """Return the oriented cloud of such points."""
    return PointCloud(*drawn(mesh, n_points, noise, seed))
