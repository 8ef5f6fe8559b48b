"""Distances of patches from triangles, compared with those of many points."""

import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.geometry.cutting.halving import edge_lengths
from weak_convex_decomposition.core.hulls.measure.fragments import (
    distances_to,
    fragments_of,
)
from weak_convex_decomposition.core.hulls.measure.targets import Targets


@pytest.mark.parametrize("seed", range(3))
def test_bounds_of_distances_hold(seed):
    rng = np.random.default_rng(seed)
    mesh = shapes.table()
    corners = mesh.vertices[mesh.triangles] / 4
    patches = rng.uniform(-1, 1, (200, 1, 3)) + rng.uniform(-0.1, 0.1, (200, 3, 3))
    centers = patches.mean(axis=1)
    at_least, nearest, at_most = Targets(corners).distances(patches, centers)
    exact = nearest_of(centers, corners)
    assert (at_least <= exact + 1e-9).all()
    assert (exact <= nearest + 1e-9).all()
    # Triangles are told by their fragments: nearly always the nearest one is found.
    assert (at_least > exact - 0.1).mean() > 0.8
    assert (nearest < exact + 1e-6).mean() > 0.9
    for shares in rng.dirichlet([1, 1, 1], 20):
        assert (nearest_of(shares @ patches, corners) <= at_most + 1e-9).all()


def test_the_nearest_triangle_is_found():
    mesh = shapes.l_prism()  # points may be nearer to fragments of the next triangle
    corners = mesh.vertices[mesh.triangles] / 2
    points = np.random.default_rng(0).uniform(-0.5, 2.5, (500, 3))
    found = Targets(corners).nearest(points)
    assert found == pytest.approx(nearest_of(points, corners), abs=1e-7)


def test_a_large_triangle_among_very_many_small_ones_is_cut_too():
    """Otherwise each of all would have to be looked at for every point."""
    sheet = shapes.sheet(320)
    small = sheet.vertices[sheet.triangles]
    assert len(small) > 200_000
    base = [[[0, 0, -0.5], [1, 1, -0.5], [0, 1, -0.5]]]
    fragments, origins = fragments_of(np.concatenate([small, base]), 0.08)
    assert edge_lengths(fragments).max() <= 0.08
    assert (origins == len(small)).sum() > 100


def nearest_of(points, corners):
    """Return the distance of each point from the nearest of all triangles."""
    away = [distances_to(points, np.tile(t, (len(points), 1, 1))) for t in corners]
    return np.min(away, axis=0)
