from dataclasses import replace

import changes
import numpy as np
import pytest
import shapes
from computed import lines_of_sight
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.geometry.sampling import (
    sample_faces,
    sample_surface,
)
from weak_convex_decomposition.core.parameters.parts import Parameters


def draw(mesh, n_samples=400, seed=0):
    return sample_surface(mesh, n_samples, np.random.default_rng(seed))


def uneven_box():
    """Return a box whose left half has 64 times as many triangles."""
    fine = changes.refined(changes.refined(changes.refined(shapes.box((0, 0, 0)))))
    return shapes.joined(fine, shapes.box((2, 0, 0), (3, 1, 1)))


@pytest.mark.parametrize("make", [shapes.l_prism, shapes.uv_sphere, shapes.comb])
def test_samples_lie_on_their_triangles(make):
    mesh = make()
    samples = draw(mesh)
    assert len(samples) == 400
    corners = mesh.vertices[mesh.triangles[samples.triangles]]
    edges = corners[:, 1:] - corners[:, :1]
    heights = ((samples.positions - corners[:, 0]) * samples.normals).sum(axis=1)
    assert heights == pytest.approx(np.zeros(400), abs=1e-9)
    for offset, (u, v) in zip(samples.positions - corners[:, 0], edges, strict=True):
        weights = np.linalg.lstsq(np.stack([u, v], axis=1), offset, rcond=None)[0]
        assert weights.min() > -1e-9
        assert weights.sum() < 1 + 1e-9
    assert (samples.normals == mesh.normals[samples.triangles]).all()


@pytest.mark.parametrize("seed", range(3))
def test_equal_areas_get_equal_numbers(seed):
    """A chi-squared test over the twelve sides of two boxes, one tessellated finely."""
    mesh = uneven_box()
    samples = draw(mesh, 1200, seed)
    sides = mesh.polygons[samples.triangles]
    counts = np.bincount(sides, minlength=12)
    # 11 degrees of freedom: 31 is passed once in a thousand random draws.
    assert ((counts - 100) ** 2 / 100).sum() < 31


def test_samples_are_uniform_within_a_triangle():
    mesh = shapes.mesh_of([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [(0, 1, 2)])
    positions = draw(mesh, 1600).positions
    assert positions.mean(axis=0) == pytest.approx([1 / 3, 1 / 3, 0], abs=0.02)
    # Cutting off each corner at the middle leaves four triangles of equal area.
    x, y, _ = positions.T
    for corner in (x > 0.5, y > 0.5, x + y < 0.5):
        assert corner.mean() == pytest.approx(0.25, abs=0.03)


def test_the_tessellation_leaves_no_trace():
    """Every eighth of two boxes gets its share, however each is tessellated."""
    samples = draw(uneven_box(), 1600)
    left = samples.positions[:, 0] < 1.5
    assert left.mean() == pytest.approx(0.5, abs=0.01)
    for half, corner in ((left, 0), (~left, 2)):
        octants = (samples.positions[half] - [corner, 0, 0] > 0.5) @ [1, 2, 4]
        counts = np.bincount(octants, minlength=8)
        assert counts == pytest.approx(np.full(8, 100), abs=30)


def test_samples_are_more_even_than_independent_draws():
    counts = [
        np.bincount(draw(shapes.box(), 600, seed).triangles // 2, minlength=6)
        for seed in range(10)
    ]
    # Independent draws vary by 100 * 5 / 6.
    assert np.var(counts) < 40


def test_the_seed_decides():
    mesh = shapes.l_prism()
    one, same, other = draw(mesh, seed=1), draw(mesh, seed=1), draw(mesh, seed=2)
    assert (one.positions == same.positions).all()
    assert (one.triangles == same.triangles).all()
    assert (one.positions != other.positions).any()


def test_no_sample_falls_on_a_triangle_without_area():
    box = shapes.box()
    flat = np.repeat(box.triangles[:, :1], 3, axis=1)
    mesh = replace(
        box,
        triangles=np.concatenate([flat, box.triangles, flat]),
        polygons=np.tile(box.polygons, 3),
    )
    triangles = draw(mesh).triangles
    assert triangles.min() >= 12
    assert triangles.max() < 24


def test_a_dense_mesh_has_a_sample_on_each_triangle():
    mesh = shapes.sphere(4)
    samples = sample_faces(mesh)
    assert (samples.triangles == np.arange(len(mesh.triangles))).all()
    centers = mesh.vertices[mesh.triangles].mean(axis=1)
    assert np.allclose(samples.positions, centers)
    assert np.allclose(samples.normals, mesh.normals)


@pytest.mark.parametrize("make", [shapes.box, shapes.comb, uneven_box])
def test_few_triangles_are_subdivided_to_three_thousand(make):
    mesh = make()
    samples = sample_faces(mesh)
    assert len(samples) == 3000
    corners = mesh.vertices[mesh.triangles[samples.triangles, 0]]
    heights = ((samples.positions - corners) * samples.normals).sum(axis=1)
    assert np.allclose(heights, 0)
    # Large triangles get their share of the samples; small ones are left whole.
    counts = np.bincount(samples.triangles, minlength=len(mesh.triangles))
    assert counts.min() >= 1
    large = mesh.areas > 4 * mesh.areas.sum() / 3000
    densities = counts[large] / mesh.areas[large]
    assert densities.max() <= 3 * densities.min()


def test_faces_without_area_are_no_samples():
    flat = shapes.mesh_of([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [(0, 1, 2)])
    samples = sample_faces(shapes.joined(flat, shapes.box()))
    assert samples.triangles.min() == 1


def test_faces_can_be_too_many_for_all_pairs():
    message = "20,480 faces have too many pairs"
    with pytest.raises(DecompositionError, match=message):
        lines_of_sight(shapes.sphere(5), Parameters(sampling="FACES"))
