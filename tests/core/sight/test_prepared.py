"""Decompositions of clouds, from end to end."""

import clouds
import numpy as np
import pytest
import shapes
from computed import decompose, measure
from weak_convex_decomposition.core.clouds import splats as splats_module
from weak_convex_decomposition.core.geometry.point_cloud import PointCloud
from weak_convex_decomposition.core.parameters.parts import Parameters

SAMPLES = 150


def split_up(cloud, **values):
    # Without containers: their grid takes the oracle half a minute.
    values = {"samples": SAMPLES, "max_parts": 6, "containers": "HOLLOW", **values}
    parameters = Parameters(**values)
    return decompose(cloud, parameters)


def check_halves(found, points, n_parts=2):
    """The cubes of a dumbbell are two parts, wherever the bar belongs."""
    assert found.n_parts == n_parts
    left, right = points[:, 0] < 2.9, points[:, 0] > 6.1
    one, other = np.bincount(found.labels[left]), np.bincount(found.labels[right])
    assert one.argmax() != other.argmax()
    assert one.max() > 0.97 * left.sum()
    assert other.max() > 0.97 * right.sum()


@pytest.mark.parametrize("noise", [0.0, 0.005, 0.01])
def test_a_dumbbell_of_points_has_two_ends(noise):
    points, normals = clouds.drawn(shapes.dumbbell(), 800, noise)
    check_halves(split_up(PointCloud(points, normals), parts=2), points)


def test_the_figures_are_those_of_the_points():
    cloud = clouds.cloud_of(shapes.comb(), 700)
    found = split_up(cloud)
    assert found.labels.shape == (700,)
    assert found.face_counts.tolist() == np.bincount(found.labels).tolist()
    assert found.areas.sum() == pytest.approx(shapes.comb().areas.sum(), rel=0.5)
    assert found.notes == ()
    assert found.normals is None


@pytest.mark.parametrize(
    "values", [{"sight": "CONE"}, {"sampling": "FACES", "sight": "CONE", "rays": 8}]
)
def test_every_way_of_looking_works(values):
    points, normals = clouds.drawn(shapes.dumbbell(), 700)
    check_halves(split_up(PointCloud(points, normals), parts=2, **values), points)


def test_inward_normals_are_turned_and_said_so():
    points, normals = clouds.drawn(shapes.dumbbell(), 700)
    found = split_up(PointCloud(points, -normals), parts=2)
    check_halves(found, points)
    assert found.normals == pytest.approx(normals)
    assert "face inwards" in found.notes[0]


def test_missing_normals_are_estimated_and_said_so():
    points, normals = clouds.drawn(shapes.dumbbell(), 800)
    found = split_up(PointCloud(points), parts=2)
    check_halves(found, points)
    assert ((found.normals * normals).sum(axis=1) > 0).mean() > 0.97
    assert "estimated" in found.notes[0]


def test_wrong_normals_are_told():
    points, normals = clouds.drawn(shapes.sphere(3), 700)
    wrong = np.random.default_rng(0).permutation(normals)
    notes = split_up(PointCloud(points, wrong), parts=2).notes
    assert any("normals of the points seem wrong" in note for note in notes)


def test_a_far_stray_point_is_no_reason_for_other_parts():
    points, _ = clouds.drawn(shapes.dumbbell(), 800)
    points = np.concatenate([points, [[5000, 0, 0]]])
    # With fewer samples, the rounding of a processor would decide on a fifth part.
    found = split_up(PointCloud(points), samples=400)
    check_halves(found, points, found.n_parts)


def test_points_beyond_the_splats_have_parts_too(monkeypatch):
    monkeypatch.setattr(splats_module, "_MOST_SPLATS", 700)
    points, normals = clouds.drawn(shapes.dumbbell(), 2000)
    check_halves(split_up(PointCloud(points, normals), parts=2), points)


def test_a_convex_cloud_has_a_high_rank_and_a_dumbbell_a_low_one():
    ranks = [
        measure(clouds.cloud_of(mesh, 700), Parameters(samples=SAMPLES)).rank
        for mesh in (shapes.sphere(3), shapes.dumbbell())
    ]
    assert ranks[0] > 0.97
    assert ranks[1] < 0.6


def test_the_same_cloud_gives_the_same_parts():
    cloud = clouds.cloud_of(shapes.plus(), 800)
    one, other = split_up(cloud), split_up(cloud)
    assert (one.labels == other.labels).all()
    assert one.psi == other.psi


def test_a_large_offset_and_scale_change_nothing():
    points, normals = clouds.drawn(shapes.dumbbell(), 700)
    found = split_up(PointCloud(1e3 * points + 1e6, normals), parts=2)
    check_halves(found, points)
