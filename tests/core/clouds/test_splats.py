import clouds
import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.clouds import splats as splats_module
from weak_convex_decomposition.core.clouds.splat_surface import splat_surface
from weak_convex_decomposition.core.clouds.splats import (
    areas_of_points,
    nearest_points,
    normal_weight,
    smoothed,
    splats,
    thinned_splats,
)
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.geometry.point_cloud import PointCloud
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run


def test_splats_are_centered_on_their_points_and_face_along_their_normals():
    points, normals = clouds.drawn(shapes.sphere(3), 200)
    targets = splats(points, normals, np.full(200, 0.01))
    assert targets.vertices.reshape(200, 3, 3).mean(axis=1) == pytest.approx(points)
    assert targets.normals == pytest.approx(normals)
    assert targets.areas == pytest.approx(np.full(200, 0.015))


def test_areas_follow_the_density():
    points, normals = clouds.drawn(shapes.box(divisions=8), 3000)
    dense = points[:, 0] < 0.5
    kept = dense | (np.arange(3000) % 4 == 0)
    points, normals, dense = points[kept], normals[kept], dense[kept]
    areas = areas_of_points(points, normals)
    assert areas.sum() == pytest.approx(6, rel=0.2)
    ratio = np.median(areas[~dense]) / np.median(areas[dense])
    assert ratio == pytest.approx(4, rel=0.2)
    spacing = np.sqrt(np.median(areas))
    assert normal_weight(points) == pytest.approx(1.5 * spacing, rel=0.1)


def test_the_far_side_of_a_thin_wall_is_not_near():
    points, normals = clouds.drawn(shapes.box(high=(1, 1, 0.02), divisions=8), 1000)
    nearest = nearest_points(points, normals, 9)
    assert (nearest[:, 0] == np.arange(1000)).all()
    faces = np.abs(normals[:, 2]) > 0.5
    same = (normals[nearest[faces]] * normals[faces, None]).sum(axis=2) > 0.5
    assert same.mean() > 0.98


def test_points_that_coincide_and_strays_have_splats_of_bounded_size():
    points, normals = clouds.drawn(shapes.sphere(3), 400)
    points = np.concatenate([points, np.repeat(points[:1], 30, axis=0), [[9, 9, 9]]])
    normals = np.concatenate([normals, np.repeat(normals[:1], 31, axis=0)])
    areas = areas_of_points(points, normals)
    assert areas.min() > 0
    assert areas.max() <= 30 * np.median(areas[30:400])


def test_hardly_any_ray_slips_through_splats_in_and_out():
    points, normals = clouds.drawn(shapes.sphere(3), 2000)
    targets = splats(points, normals, areas_of_points(points, normals))
    directions = np.random.default_rng(1).normal(size=(1000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    starts = -2 * directions
    hits, _ = BruteCaster(targets).first_hit(starts, directions, np.full(1000, 4.0))
    assert (hits < 0).mean() < 0.05


def test_smoothing_takes_noise_out_and_leaves_curvature():
    mesh = shapes.sphere(4)
    clean, normals = clouds.drawn(mesh, 2000)
    noisy, _ = clouds.drawn(mesh, 2000, noise=0.01)

    def roughness(points):
        return np.std(np.linalg.norm(points, axis=1))

    radii = np.linalg.norm(smoothed(clean, normals), axis=1)
    assert radii == pytest.approx(np.ones(2000), abs=0.01)
    assert roughness(smoothed(noisy, normals)) < 0.5 * roughness(noisy)


def test_thinning_keeps_all_of_few_and_an_even_share_of_many(monkeypatch):
    points, normals = clouds.drawn(shapes.box(divisions=8), 4000)
    sparse = (points[:, 0] > 0.5) & (np.arange(4000) % 4 != 0)
    points, normals = points[~sparse], normals[~sparse]
    kept, _, _ = thinned_splats(points, normals)
    assert (kept == np.arange(len(points))).all()
    monkeypatch.setattr(splats_module, "_MOST_SPLATS", 500)
    kept, areas, targets = thinned_splats(points, normals)
    assert 400 < len(kept) == len(areas) == targets.n_polygons <= 500
    assert areas.sum() == pytest.approx(6, rel=0.5)  # edges count twice
    assert (points[kept, 0] < 0.5).mean() == pytest.approx(0.5, abs=0.08)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("with_normals", [True, False])
@pytest.mark.parametrize("rounding", [0.0, 1e-15, 1e-11])
def test_copies_of_points_change_nothing(with_normals, rounding):
    points, normals = clouds.drawn(shapes.dumbbell(), 300)
    order = np.repeat(np.arange(300), 10)
    noise = rounding * np.random.default_rng(0).normal(size=(3000, 3))
    noise[::10] = 0
    alone, copied = (
        run(splat_surface(PointCloud(places, *[normals[rows]] * with_normals)))
        for places, rows in (
            (points, np.arange(300)),
            (points[order] + noise, order),
        )
    )
    close = {"rel": 0, "abs": 1e3 * rounding}
    assert copied.mesh.vertices == pytest.approx(alone.mesh.vertices, **close)
    assert (copied.nodes == alone.nodes[order]).all()
    if not with_normals:
        found, expected = copied.found_normals, alone.found_normals[order]
        assert found == pytest.approx(expected, **close)


@pytest.mark.parametrize("n_points", [16, 100, 600])
@pytest.mark.parametrize("with_normals", [True, False])
def test_a_flat_cloud_is_one_part_and_says_so(n_points, with_normals):
    random = np.random.default_rng(0)
    turned = np.linalg.qr(random.normal(size=(3, 3)))[0]
    points = random.random((n_points, 3)) * (2, 1, 1e-5) @ turned
    normals = [np.tile(turned[2], (n_points, 1))] * with_normals
    cloud, cache = PointCloud(points, *normals), ShapeCache(BruteCaster)
    found = run(decompose_in_steps(cloud, Parameters(samples=100), cache))
    assert found.n_parts == 1
    assert [note for note in found.notes if "lie in a plane" in note]
