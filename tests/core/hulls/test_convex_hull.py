import numpy as np
import pytest
import shapes
from definitions import assert_convex
from scipy.spatial import ConvexHull
from weak_convex_decomposition.core.geometry.primitives import CollisionShape
from weak_convex_decomposition.core.hulls.convex_hull import (
    convex_hull,
    hull_volume,
    offset,
    simplified,
)
from weak_convex_decomposition.core.hulls.measure.uncovered import uncovered

CUBE = shapes.box().vertices


def assert_covers(simple, hull, tolerance):
    """Assert that no vertex of a hull is farther than that from a simpler one."""
    shape = CollisionShape("HULL", simple, np.zeros(3), np.eye(3), np.zeros(3))
    assert uncovered(shape, hull) <= tolerance


def test_the_hull_of_a_cube():
    inside = np.random.default_rng(0).random((50, 3))
    hull = convex_hull(np.concatenate([inside, CUBE]), 1e-3)
    assert_convex(hull)
    assert len(hull.vertices) == 8
    assert hull.volume == pytest.approx(1)
    heights = hull.heights(np.array([[0.5, 0.5, 0.5], [2, 0.5, 0.5]]))
    assert heights == pytest.approx([-0.5, 1])


@pytest.mark.parametrize(
    "points",
    [
        [[1, 2, 3]],
        [[1, 2, 3]] * 7,
        [[0, 0, 0], [1, 1, 1]],
        [[0, 0, 0], [1, 1, 1], [2, 2, 2], [5, 5, 5], [3, 3, 3]],
        [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
        [[0, 0, 5], [1, 0, 5], [0, 1, 5], [1, 1, 5], [0.5, 0.5, 5]],
        [[0, 0, 0], [1, 2, 3], [2, 1, 3], [3, 3, 6], [4, 5, 9]],  # z = x + y
    ],
    ids=["point", "same", "two", "line", "triangle", "square", "slanted"],
)
def test_flat_points_have_a_thin_hull(points):
    points = np.array(points, dtype=float)
    hull = convex_hull(points, 0.01)
    assert_convex(hull)
    assert hull.heights(points).max() < 1e-9
    assert np.linalg.norm(hull.vertices.max(axis=0) - points.max(axis=0)) <= 0.01
    assert hull_volume(points) == 0
    assert hull.is_thickened
    assert hull.volume > 0
    assert not convex_hull(shapes.box().vertices, 0.01).is_thickened


@pytest.mark.parametrize("most", [4, 5, 20, 64])
def test_simplified_hulls_are_convex_and_within(most):
    sphere = convex_hull(shapes.sphere(3).vertices, 1e-3)
    hull = simplified(sphere, most)
    assert_convex(hull)
    assert len(hull.vertices) == most
    assert sphere.heights(hull.vertices).max() < 1e-9
    # Not much worse than as many vertices can be: random ones are.
    rng = np.random.default_rng(0)
    rows = rng.permutation(len(sphere.vertices))[:most]
    assert hull.volume > ConvexHull(sphere.vertices[rows]).volume


def test_what_is_nearly_flat_has_no_vertices():
    def vertices_with(bump):
        hull = convex_hull(np.concatenate([CUBE, [bump]]), 1e-3)
        return len(simplified(hull, 64).vertices), len(simplified(hull, 7).vertices)

    assert vertices_with([0.5, 0.5, 1.0003]) == (9, 7)
    assert vertices_with([0.5, 0.5, 1.0001]) == (8, 7)


@pytest.mark.parametrize("thickness", [0.1, 0.01, 1e-3, 1e-4])
def test_simplified_hulls_cover_thin_ones(thickness):
    rng = np.random.default_rng(0)
    for _ in range(10):
        points = rng.normal(size=(rng.integers(4, 60), 3))
        points /= np.linalg.norm(points, axis=1, keepdims=True)
        points *= [1, 1, thickness / 2]
        hull = convex_hull(points, 2e-3)
        assert_covers(simplified(hull, 64), hull, 2e-4)


def test_offset_moves_every_face():
    cube = convex_hull(CUBE, 1e-3)
    assert offset(cube, 0) is cube
    assert offset(cube, 0.25).volume == pytest.approx(1.5**3)
    assert offset(cube, -0.25).volume == pytest.approx(0.5**3)
    assert offset(cube, -0.5) is cube
    assert_convex(offset(cube, 0.25))


def test_hulls_shrink_also_where_most_vertices_are_at_one_corner():
    rng = np.random.default_rng(0)
    corner = np.abs(rng.normal(size=(600, 3)))
    corner = 0.97 + 0.03 * corner / np.linalg.norm(corner, axis=1, keepdims=True)
    hull = convex_hull(np.concatenate([CUBE[:-1], corner]), 1e-3)
    for margin in (-0.02, -0.1, -0.4):
        expected = (1 + 2 * margin) ** 3
        assert offset(hull, margin).volume == pytest.approx(expected, rel=0.01)
    assert offset(hull, -0.5) is hull
