from dataclasses import replace

import numpy as np
import pytest
from changes import any_rotation, moved
from computed import lines_of_sight, measure, prepare
from flats import filled
from shapes import box, dumbbell, l_prism, mesh_of
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.sight.point_view import point_viewer_in_steps
from weak_convex_decomposition.core.steps.progress import run

PARAMETERS = Parameters(samples=100)


def viewer_of(mesh, parameters=PARAMETERS):
    return run(point_viewer_in_steps(prepare(mesh), parameters))


def test_a_convex_shape_is_seen_whole():
    view = viewer_of(box(divisions=3)).look(np.array([0.5, 0.4, 5]), -np.eye(3)[2])
    assert view.point == pytest.approx([0.5, 0.4, 1.0])
    on_top = view.places[:, 2] > 1 - 1e-6
    # A point sees no other point of its own flat face: the segment is not inside.
    assert view.visible[~on_top].all()


def test_a_point_sees_its_ball_of_a_dumbbell_and_little_of_the_other():
    mesh = moved(dumbbell(), scale=7.0, offset=(3, -20, 1))
    low, high = mesh.bounds
    longest = (high - low).argmax()
    axis = np.eye(3)[longest]
    viewer = viewer_of(mesh)
    across = np.eye(3)[(longest + 1) % 3]
    middle = (low + high) / 2
    near = middle - 0.35 * (high - low)[longest] * axis
    view = viewer.look(near + 100 * across, -across)
    mine = (view.places - middle) @ axis < 0
    assert view.visible[mine].mean() > 0.5
    assert view.visible[~mine].mean() < 0.2
    assert (view.places >= low - 1e-6).all()
    assert (view.places <= high + 1e-6).all()
    assert np.linalg.norm(view.normals, axis=1) == pytest.approx(1.0)


def test_a_ray_beside_the_shape_sees_nothing():
    assert viewer_of(box()).look(np.array([5.0, 5, 5]), np.eye(3)[0]) is None


def test_what_is_seen_agrees_with_the_matrix():
    """A point on a sample sees what the matrix says the sample sees."""
    mesh = l_prism()
    sight = lines_of_sight(mesh, PARAMETERS)
    viewer = viewer_of(mesh)
    assert (viewer.views.samples.positions == sight.samples.positions).all()
    places = sight.samples.positions * mesh.diagonal + mesh.center
    shares = []
    for row in range(0, len(places), 10):
        outwards = sight.samples.normals[row]
        view = viewer.look(places[row] + 1e-4 * outwards, -outwards)
        others = np.arange(len(places)) != row
        shares.append((view.visible == sight.rank_pairs.visible[row])[others].mean())
    assert np.mean(shares) > 0.99


def test_a_flat_shape_is_seen_from_the_nearest_sample_of_its_outline():
    square = np.array([(0.0, 0), (2, 0), (2, 2), (0, 2)])
    mesh = filled(square, spacing=0.5)
    view = viewer_of(mesh).look(np.array([1.9, 1.0, 5.0]), -np.eye(3)[2])
    assert view.point[0] == pytest.approx(2.0, abs=1e-6)
    assert view.visible[view.places[:, 0] < 0.1].all()


def faces_of(mesh, chosen):
    return np.isin(np.arange(mesh.n_polygons), mesh.polygons[chosen])


def centers(mesh):
    return mesh.vertices[mesh.triangles].mean(axis=1)


def test_all_faces_have_the_rank_of_the_shape():
    mesh = l_prism()
    sight = lines_of_sight(mesh, replace(PARAMETERS, sight="ALL_PAIRS"))
    expected, _ = sight.rank_pairs.rank_of_all()
    everything = np.ones(mesh.n_polygons, dtype=bool)
    found = measure(mesh, PARAMETERS, everything)
    assert found.rank == pytest.approx(expected, abs=1e-12)
    assert found.n_samples == 100


def test_one_ball_of_a_dumbbell_is_more_convex_than_both():
    mesh = moved(dumbbell(), rotation=any_rotation(2))
    along = (centers(mesh) - mesh.center) @ np.linalg.svd(centers(mesh) - mesh.center)[
        2
    ][0]
    everything = np.ones(mesh.n_polygons, dtype=bool)
    both = measure(mesh, PARAMETERS, everything)
    ball = faces_of(mesh, along > 0.25 * np.ptp(along))
    assert 0 < ball.sum() < mesh.n_polygons
    one = measure(mesh, PARAMETERS, ball)
    assert one.rank > both.rank + 0.2


def test_faces_without_area_are_told():
    mesh = mesh_of(
        [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (2, 0, 0)],
        [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2), (0, 1, 4)],
    )
    only_last = np.arange(mesh.n_polygons) == mesh.n_polygons - 1
    with pytest.raises(DecompositionError, match="no area"):
        measure(mesh, PARAMETERS, only_last)


def test_a_ray_may_come_from_afar():
    """Views without perspective start rays at the far end of what they show."""
    viewer = viewer_of(box(divisions=3))
    for distance in (1e2, 1e5, 1e8):
        view = viewer.look(np.array([0.5, 0.4, distance]), -np.eye(3)[2])
        assert view.point == pytest.approx([0.5, 0.4, 1.0], abs=1e-5)
