import changes
import numpy as np
import pytest
import shapes
from computed import graph_of
from weak_convex_decomposition.core.geometry import transfer
from weak_convex_decomposition.core.geometry.cutting.piece_labels import labels_by_area
from weak_convex_decomposition.core.geometry.sampling import sample_surface
from weak_convex_decomposition.core.geometry.transfer import NearestSamples
from weak_convex_decomposition.core.geometry.transfer import carry as transfer_in_steps
from weak_convex_decomposition.core.steps.progress import run


def carry(mesh, n_samples=300, seed=0):
    samples = sample_surface(mesh, n_samples, np.random.default_rng(seed))
    polygons = mesh.polygons[samples.triangles]
    return samples, run(transfer_in_steps(samples, polygons, graph_of(mesh)))


def test_what_is_kept_is_what_is_found_anew(monkeypatch):
    mesh = shapes.l_shape()
    surface, places = graph_of(mesh), np.arange(104)
    samples = sample_surface(mesh, 50, np.random.default_rng(0))
    kept = NearestSamples(samples, 0.7)
    for most in (1000, 1):  # then nothing is kept
        monkeypatch.setattr(transfer, "_MOST_KEPT", most)
        for chosen in (places[10:30], places[20:60:3], places, places[::-1]):
            part = surface.part(chosen)
            anew = NearestSamples(samples, 0.7).of(part, chosen)
            known = run(kept.of(part, chosen + 500))
            for one, other in zip(run(anew), known, strict=True):
                assert (one == other).all()


def test_the_says_of_samples_sum_to_one():
    _, transfer = carry(shapes.l_shape())
    assert transfer.shares.shape == (104, 300)
    assert transfer.shares.sum(axis=1) == pytest.approx(np.ones(104))
    assert transfer.shares.data.min() > 0


def test_samples_know_their_polygon():
    mesh = shapes.l_shape()
    samples, transfer = carry(mesh)
    assert (transfer.polygon_of == mesh.polygons[samples.triangles]).all()
    labels = np.arange(104)
    assert (transfer.to_samples(labels) == transfer.polygon_of).all()


@pytest.mark.parametrize("change", [lambda mesh: mesh, changes.refined, changes.split])
def test_polygons_take_the_label_of_the_samples_around_them(change):
    mesh = change(shapes.l_shape())
    samples, transfer = carry(mesh)
    labels = (samples.positions[:, 0] > 3.5).astype(int)
    labels[samples.positions[:, 1] > 3.5] = 2
    x, y, _ = transfer.graph.centers.T
    polygons = transfer.to_polygons(labels, 3)
    clear = (np.abs(x - 3.5) > 0.4) & (np.abs(y - 3.5) > 0.4)
    expected = np.where(y > 3.5, 2, x > 3.5)
    assert (polygons == expected)[clear].all()


def test_the_two_sides_of_a_thin_wall_do_not_mix():
    # Most polygons have no sample of their own.
    wall = shapes.box((0, 0, 0), (1, 1, 0.01), 12)
    samples, transfer = carry(wall, 60)
    labels = (samples.normals[:, 2] > 0).astype(int)
    polygons = transfer.to_polygons(labels, 2)
    up = transfer.graph.normals[:, 2]
    assert (polygons[up > 0.9] == 1).all()
    assert (polygons[up < -0.9] == 0).all()


def test_a_polygon_much_larger_than_the_samples_takes_what_most_of_them_have():
    samples, transfer = carry(shapes.box())
    # Two thirds of each side are 1, its middle excepted.
    labels = (samples.positions.min(axis=1) > -1).astype(int)
    labels[np.random.default_rng(0).random(300) < 0.3] = 0
    assert (transfer.to_polygons(labels, 2) == 1).all()


def n_connected(surface):
    alike = np.zeros(surface.n_polygons, dtype=int)
    return len(set(surface.pieces(alike, 0.0)))


def test_shells_that_touch_are_linked_and_others_are_not():
    crossing = shapes.joined(
        shapes.box((0, 0, 0), (3, 1, 1), 3),
        shapes.box((0.2, -1, 0.2), (0.8, 2, 0.8), 3),
    )
    apart = shapes.joined(shapes.box(), shapes.box((9, 0, 0), (10, 1, 1)))
    assert n_connected(carry(crossing)[1].graph) == 1
    assert n_connected(carry(apart)[1].graph) == 2


def test_a_shell_without_samples_hangs_on_the_nearest_one():
    speck = shapes.box((3.2, 0.5, 0.5), (3.2001, 0.5001, 0.5001))
    mesh = shapes.joined(shapes.box(), speck, shapes.box((4, 0, 0), (5, 1, 1)))
    samples, transfer = carry(mesh)
    assert samples.triangles.max() >= 24
    assert not ((samples.triangles >= 12) & (samples.triangles < 24)).any()
    assert n_connected(transfer.graph) == 2
    one, other = transfer.graph.links.T
    assert ((one >= 6) & (one < 12) & (other >= 12)).any()


def test_a_face_gets_the_label_that_covers_most_of_it():
    labels = np.array([2, 0, 2, 1, 3, 1])
    origins = np.array([5, 5, 5, 0, 0, 7])
    areas = np.array([1.0, 1.5, 1.0, 2.0, 2.0 + 1e-6, 0.0])
    faces, found, counts = labels_by_area(labels, origins, areas)
    assert faces.tolist() == [0, 5, 7]
    assert found.tolist() == [1, 2, 1]  # of equal areas the lowest label
    assert counts.tolist() == [2, 2, 1]


def test_a_label_that_keeps_little_of_what_it_covers_leaves_it_to_others():
    """The seam between body and arm is one face off in the second of two copies."""
    labels = np.repeat([0, 3, 2, 4], [20, 3, 21, 2])
    origins = np.r_[0:23, 0:23]
    _, found, counts = labels_by_area(labels, origins, np.ones(46))
    assert found.tolist() == [0] * 20 + [3] * 3  # 2 has the lower number at the seam
    assert (counts == 2).all()
