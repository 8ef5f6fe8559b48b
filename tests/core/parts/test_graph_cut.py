from itertools import product

import numpy as np
import pytest
import shapes
from computed import graph_of as graph_of_mesh
from weak_convex_decomposition.core.geometry.graphs.face_graph import FaceGraph
from weak_convex_decomposition.core.parts.seams import graph_cut
from weak_convex_decomposition.core.parts.seams.cutter import distances_to_parts
from weak_convex_decomposition.core.parts.seams.graph_cut import cut_seams
from weak_convex_decomposition.core.steps.progress import run


def graph_of(neighbors, n_nodes, lengths=1.0, bends=0.0, areas=1.0):
    neighbors = np.array(neighbors, dtype=np.int64).reshape(-1, 2)

    def filled(values, number):
        return np.broadcast_to(np.asarray(values, dtype=float), number).copy()

    flat = np.zeros((n_nodes, 3))
    return FaceGraph(
        areas=filled(areas, n_nodes),
        centers=flat,
        normals=np.tile([0.0, 0.0, 1.0], (n_nodes, 1)),
        neighbors=neighbors,
        lengths=filled(lengths, len(neighbors)),
        bends=filled(bends, len(neighbors)),
    )


def random_graph(seed, n_nodes=9, n_labels=2):
    """Return a connected graph, labels and costs; each label has a node of its own."""
    rng = np.random.default_rng(seed)
    pairs = np.array([(i, j) for i in range(n_nodes) for j in range(i)])
    chosen = pairs[(rng.random(len(pairs)) < 0.3) | (pairs[:, 0] == pairs[:, 1] + 1)]
    areas = 0.1 + rng.random(n_nodes)
    surface = graph_of(chosen, n_nodes, rng.random(len(chosen)), areas=areas)
    labels = rng.integers(n_labels, size=n_nodes)
    costs = rng.random((n_nodes, n_labels))
    # A label that is lost on the way cannot come back.
    labels[:n_labels] = np.arange(n_labels)
    costs[:n_labels] = 50 * (1 - np.eye(n_labels))
    return surface, labels, costs


def energy(surface, labels, costs, smoothness):
    """Return eq. 4 on a flat surface."""
    total = surface.areas.sum()
    data = (costs[np.arange(len(labels)), labels] * surface.areas).sum() / total
    one, other = labels[surface.neighbors].T
    seams = surface.lengths[one != other].sum() / np.sqrt(total)
    return data + smoothness * graph_cut._SEAM_UNIT * seams


def cut(surface, labels, costs, smoothness):
    return run(cut_seams(surface, labels, costs, smoothness))


WEIGHTS = (0.0, 1.0, 20.0, 100.0)


@pytest.mark.parametrize("smoothness", WEIGHTS)
@pytest.mark.parametrize("seed", range(4))
def test_two_labels_reach_the_optimum(seed, smoothness):
    surface, labels, costs = random_graph(seed)
    found = energy(surface, cut(surface, labels, costs, smoothness), costs, smoothness)
    best = min(
        energy(surface, np.array(choice), costs, smoothness)
        for choice in product((0, 1), repeat=9)
    )
    assert found == pytest.approx(best, abs=1e-5)


@pytest.mark.parametrize("smoothness", WEIGHTS)
@pytest.mark.parametrize("seed", range(4))
def test_the_energy_never_rises(seed, smoothness):
    surface, labels, costs = random_graph(seed, 40, 4)
    before = labels.copy()
    after = cut(surface, labels, costs, smoothness)
    assert (labels == before).all()
    risen = energy(surface, after, costs, smoothness) - energy(
        surface, labels, costs, smoothness
    )
    assert risen <= 1e-6


@pytest.mark.parametrize("seed", range(4))
def test_no_move_of_one_polygon_gains_anything(seed):
    surface, labels, costs = random_graph(seed, 20, 3)
    after = cut(surface, labels, costs, 20.0)
    lowest = energy(surface, after, costs, 20.0)
    for node, label in product(range(20), set(after)):
        other = after.copy()
        other[node] = label
        assert energy(surface, other, costs, 20.0) >= lowest - 1e-6


@pytest.mark.parametrize("seed", range(20))
def test_labels_that_have_seen_nothing_move_would_not_move(seed, monkeypatch):
    surface, labels, costs = random_graph(seed, n_nodes=40, n_labels=5)
    monkeypatch.setattr(graph_cut, "_BAND", 1)
    found = cut(surface, labels, costs, 20.0)
    expand = graph_cut._Expansion.expand

    def see_everything(*arguments):
        moved, seen = expand(*arguments)
        return moved, np.ones_like(seen)

    monkeypatch.setattr(graph_cut._Expansion, "expand", see_everything)
    assert (cut(surface, labels, costs, 20.0) == found).all()


def test_without_smoothness_each_polygon_has_its_favorite():
    surface, labels, costs = random_graph(1, 12, 3)
    assert (cut(surface, labels, costs, 0.0) == costs.argmin(axis=1)).all()


@pytest.mark.parametrize("number", [2, 100, 200, 256, 1000])
def test_many_links_between_two_polygons_hold_them_together(number):
    """Shells that touch are linked by every near pair of samples."""
    chain = np.repeat([(0, 1), (1, 2), (2, 3)], [1, number, 1], axis=0)
    lengths = np.repeat([1e-3, 1.0, 1e-3], [1, number, 1])
    costs = np.array([(0.5, 0), (0.04, 0), (0, 0.08), (0, 0.5)])
    after = cut(graph_of(chain, 4, lengths), np.array([1, 0, 0, 0]), costs, 100.0)
    assert after.tolist() == [1, 0, 0, 0]


def test_one_label_and_no_edges_are_left_alone():
    surface = graph_of([], 3)
    assert (
        cut(surface, np.zeros(3, dtype=int), np.ones((3, 1)), 2.0).tolist() == [0] * 3
    )
    costs = np.array([[0, 1], [1, 0], [0, 1.0]])
    labels = np.array([0, 1, 0])
    assert cut(surface, labels, costs, 2.0).tolist() == [0, 1, 0]


def test_a_wandering_seam_moves_into_the_crease():
    """The seam wanders along a bar between two cubes, with creases at its ends."""
    surface = graph_of_mesh(shapes.dumbbell())
    x, y, z = surface.centers.T
    labels = (x > np.where((y + z) % 2 < 1, 4, 5)).astype(int)
    # The samples of the bar are undecided, those of the cubes are not.
    costs = np.stack([x > 6 - 1e-6, x < 3 + 1e-6], axis=1).astype(float)
    after = cut(surface, labels, costs, 2.0)
    bar = (x > 3 + 1e-6) & (x < 6 - 1e-6)
    assert len(set(labels[bar])) == 2
    assert len(set(after[bar])) == 1
    assert (after[x < 3 - 1e-6] == 0).all()
    assert (after[x > 6 + 1e-6] == 1).all()


def test_seams_prefer_creases_to_ridges_and_flats():
    def seam_at(bends):
        chain = [(0, 1), (1, 2), (2, 3), (3, 4)]
        surface = graph_of(chain, 5, bends=bends)
        costs = np.full((5, 2), 0.5)
        costs[0], costs[4] = (0, 1), (1, 0)
        after = cut(surface, np.array([0, 0, 1, 1, 1]), costs, 20.0)
        return np.flatnonzero(np.diff(after)).tolist()

    for place in range(4):
        bends = np.array([-0.5, 0.0, -1.0, 0.0])
        bends[place] = 1.0
        assert seam_at(bends) == [place]


def test_dislikes_grow_with_the_distance_to_the_center():
    rng = np.random.default_rng(0)
    labels = np.repeat([0, 1, 2], 20)
    embedding = np.eye(3)[labels] + 0.1 * rng.normal(size=(60, 3))
    costs = distances_to_parts(embedding, labels, 3)
    assert costs.shape == (60, 3)
    assert (costs.argmin(axis=1) == labels).all()
    assert costs.min() >= 0
    assert np.isfinite(costs).all()
    own = costs[np.arange(60), labels]
    centers = np.stack([embedding[labels == k].mean(axis=0) for k in range(3)])
    distances = np.linalg.norm(embedding - centers[labels], axis=1)
    assert (np.argsort(own[:20]) == np.argsort(distances[:20])).all()


def test_dislikes_of_samples_in_one_place_are_finite():
    assert np.isfinite(
        distances_to_parts(np.ones((10, 2)), np.repeat([0, 1], 5), 2)
    ).all()


def test_dislikes_of_a_label_without_samples_are_finite():
    assert np.isfinite(distances_to_parts(np.eye(4), np.array([0, 0, 1, 1]), 3)).all()
