import clouds
import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.clouds import outward as module
from weak_convex_decomposition.core.clouds.outward import outward_directions
from weak_convex_decomposition.core.steps.progress import run


def outward(mesh, n_points, noise=0.0, blur=0.5):
    """Return the cosines between directions found on a mesh and its normals."""
    points, normals = clouds.drawn(mesh, n_points, noise)
    points = (points - points.mean(axis=0)) / mesh.diagonal
    found = run(outward_directions(points, blur))
    assert np.linalg.norm(found, axis=1) == pytest.approx(np.ones(n_points), abs=1e-5)
    return (found * normals).sum(axis=1)


def test_directions_of_a_sphere_are_its_normals():
    assert outward(shapes.sphere(4), 1000).min() > 0.95


def test_a_thin_board_has_two_sides():
    assert (outward(shapes.box(high=(1, 1, 0.02)), 2000) > 0).mean() > 0.97


def test_the_inner_side_of_a_wall_faces_the_hollow():
    assert (outward(shapes.cup(), 2500) > 0).mean() > 0.99


@pytest.mark.parametrize("noise", [0.005, 0.01])
def test_blurred_points_tell_sides_through_noise(noise):
    sharp, blurred = (
        (outward(shapes.comb(), 2000, noise, blur) > 0).mean() for blur in (0.2, 1.0)
    )
    assert blurred > 0.99
    assert blurred >= sharp


def test_few_drawn_points_tell_the_others(monkeypatch):
    monkeypatch.setattr(module, "_DRAWN", 600)
    assert (outward(shapes.dumbbell(), 3000) > 0).mean() > 0.99


def test_size_does_not_matter_but_for_rounding():
    points, _ = clouds.drawn(shapes.comb(), 500)
    points -= points.mean(axis=0)
    one, other = (run(outward_directions(points * size, 0.5)) for size in (0.1, 1.0))
    assert (one * other).sum(axis=1).min() > 0.999


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("away", [30, 1000, 2300])
def test_a_stray_point_far_away_changes_no_direction(away):
    points, normals = clouds.drawn(shapes.sphere(3), 600)
    stray = np.concatenate([points, [[away, 0, 0]]])
    diagonal = np.linalg.norm(np.ptp(stray, axis=0))
    found = run(outward_directions((stray - [away / 2, 0, 0]) / diagonal, 0.5))
    assert (found[:-1] * normals).sum(axis=1).min() > 0.95


def test_it_reports_its_progress():
    points, _ = clouds.drawn(shapes.sphere(2), 1200)
    fractions = [each.fraction for each in outward_directions(points, 0.5)]
    assert fractions == sorted(fractions)
    assert len(fractions) > 20
    assert fractions[-1] <= 1.0
