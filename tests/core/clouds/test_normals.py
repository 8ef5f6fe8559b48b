import clouds
import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.clouds import normals as normals_module
from weak_convex_decomposition.core.clouds import splats as splats_module
from weak_convex_decomposition.core.clouds.normals import (
    estimate_normals,
    face_inwards,
    seem_wrong,
)
from weak_convex_decomposition.core.steps.progress import run


def normalized(mesh, n_points, noise=0.0):
    points, normals = clouds.drawn(mesh, n_points, noise)
    return points / mesh.diagonal, normals


@pytest.mark.parametrize(
    "make",
    [
        shapes.dumbbell,
        shapes.comb,
        lambda: shapes.joined(shapes.sphere(3), shapes.sphere(3, 0.5, (3, 0, 0))),
        lambda: shapes.box(high=(1, 1, 0.1), divisions=8),
    ],
)
@pytest.mark.parametrize("noise", [0.0, 0.003, 0.01])
def test_estimated_normals_point_outwards(make, noise):
    points, normals = normalized(make(), 700, noise)
    found = run(estimate_normals(points))[0]
    assert np.linalg.norm(found, axis=1) == pytest.approx(np.ones(700))
    cosines = (found * normals).sum(axis=1)
    assert (cosines > 0).mean() > 0.97
    assert np.median(cosines) > (0.9 if noise < 0.01 else 0.85)


def test_points_that_are_thinned_out_get_normals_too(monkeypatch):
    monkeypatch.setattr(splats_module, "_MOST_SPLATS", 500)
    points, normals = normalized(shapes.dumbbell(), 1500)
    found = run(estimate_normals(points))[0]
    assert ((found * normals).sum(axis=1) > 0).mean() > 0.97


def test_noise_is_measured_once_if_no_point_is_thinned_out(monkeypatch):
    measured = []

    def noise_of(points):
        measured.append(len(points))
        return 0.02

    monkeypatch.setattr(normals_module, "noise_of", noise_of)
    points, _ = normalized(shapes.dumbbell(), 300)
    run(estimate_normals(points))
    assert measured == [300]
    monkeypatch.setattr(splats_module, "_MOST_SPLATS", 200)
    run(estimate_normals(points))
    assert len(measured) == 3


def test_inward_normals_are_noticed():
    for mesh in (shapes.dumbbell(), shapes.cup(), shapes.open_box()):
        points, normals = clouds.drawn(mesh, 800)
        assert not face_inwards(points, normals)
        assert face_inwards(points, -normals)


def test_a_sheet_faces_nowhere():
    points, normals = clouds.drawn(shapes.sheet(), 800)
    assert not face_inwards(points, normals)
    assert not face_inwards(points, -normals)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_either_side_of_a_bent_board_may_have_been_scanned(side):
    rng = np.random.default_rng(0)
    angles = rng.uniform(-0.4, 0.4, 800)
    normals = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    points = normals + rng.uniform(0, 0.2, 800)[:, None] * (0, 0, 1)
    assert not face_inwards(points, side * normals)


def test_a_scan_of_one_side_that_faces_inwards_is_noticed():
    points, normals = clouds.drawn(shapes.sphere(3), 800)
    seen = normals[:, 1] > 0.2
    assert not face_inwards(points[seen], normals[seen])
    assert face_inwards(points[seen], -normals[seen])


def test_wrong_normals_are_noticed():
    points, normals = normalized(shapes.sphere(3), 2000)
    rng = np.random.default_rng(0)
    signs = np.where(rng.random(2000) < 0.5, -1, 1)[:, None]
    noise = rng.normal(size=(2000, 3))
    assert not seem_wrong(points, normals)
    assert not seem_wrong(points, -normals)
    assert seem_wrong(points, normals * signs)
    assert seem_wrong(points, noise / np.linalg.norm(noise, axis=1, keepdims=True))
    assert seem_wrong(points, np.tile([0.0, 0.0, 1.0], (2000, 1)))


@pytest.mark.parametrize("thickness", [0.02, 0.001, 1e-9])
def test_the_two_sides_of_a_board_are_not_wrong(thickness):
    assert not seem_wrong(*normalized(shapes.box(high=(1, 1, thickness)), 2000))


@pytest.mark.parametrize("noise", [0.003, 0.01, 0.03])
@pytest.mark.parametrize("make", [shapes.cup, shapes.comb, shapes.plus])
def test_noise_makes_no_normals_wrong(make, noise):
    assert not seem_wrong(*normalized(make(), 1000, noise))
