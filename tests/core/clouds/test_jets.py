import clouds
import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.clouds.jets import jet_normals
from weak_convex_decomposition.core.clouds.splats import noise_of, normal_weight
from weak_convex_decomposition.core.steps.progress import run


def fitted(points, normals, n_neighbors):
    """Return the normals of jets through so many neighbors."""
    weight = normal_weight(points)
    return run(jet_normals(points, normals, weight, n_neighbors))


def tilted(normals, angle, seed=0):
    """Return unit normals that are off by some angle, each in its own direction."""
    aside = np.cross(normals, np.random.default_rng(seed).normal(size=normals.shape))
    aside /= np.linalg.norm(aside, axis=1, keepdims=True)
    return np.cos(angle) * normals + np.sin(angle) * aside


@pytest.mark.parametrize("n_neighbors", [10, 30])
def test_jets_of_quadratic_surfaces_are_nearly_exact(n_neighbors):
    places = np.random.default_rng(0).uniform(-1, 1, size=(2000, 2))
    across, up = places.T
    heights = 0.5 * across**2 - 0.3 * across * up + 0.2 * up
    normals = np.stack([0.3 * up - across, 0.3 * across - 0.2, np.ones(2000)], axis=1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    points = np.column_stack([places, heights])
    found = fitted(points, tilted(normals, 0.2), n_neighbors)
    inner = np.abs(places).max(axis=1) < 0.8
    assert np.linalg.norm(found, axis=1) == pytest.approx(np.ones(2000))
    assert np.quantile((found * normals).sum(axis=1)[inner], 0.01) > 0.999


def test_jets_keep_to_one_side_of_a_thin_board():
    points, normals = clouds.drawn(shapes.box(high=(1, 1, 0.03), divisions=4), 2000)
    found = fitted(points, tilted(normals, 0.3), 12)
    flat = np.abs(normals[:, 2]) > 0.9
    assert np.median((found * normals).sum(axis=1)[flat]) > 0.99


def test_more_neighbors_average_more_noise():
    points, normals = clouds.drawn(shapes.sphere(4), 3000, 0.01)
    few, many = (
        (fitted(points, normals, n) * normals).sum(axis=1).mean() for n in (10, 54)
    )
    assert many > few + 0.02


def test_clouds_of_hardly_any_points_get_normals_too():
    points, normals = clouds.drawn(shapes.box(), 12)
    found = fitted(points, normals, 54)
    assert np.isfinite(found).all()


def test_noise_is_told_from_a_surface():
    levels = [
        noise_of(clouds.drawn(shapes.sphere(4), 3000, noise)[0])
        for noise in (0.0, 0.002, 0.005, 0.01, 0.02)
    ]
    assert levels == sorted(levels)
    assert levels[0] < 0.05 < levels[1]
    assert 0.45 < levels[-1] < 0.7
