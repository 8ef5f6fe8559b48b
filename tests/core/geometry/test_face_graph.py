from dataclasses import replace

import changes
import numpy as np
import pytest
import shapes
from computed import graph_of
from weak_convex_decomposition.core.geometry.graphs import components, edges
from weak_convex_decomposition.core.steps.progress import run


def bend_at(surface, place):
    """Return the bend of the only edge whose neighbors' centers lie around a place."""
    middles = surface.centers[surface.neighbors].mean(axis=1)
    found = np.flatnonzero(np.linalg.norm(middles - place, axis=1) < 1e-6)
    assert len(found) == 1
    return surface.bends[found[0]]


def edges_of(surface):
    return {frozenset(pair) for pair in surface.neighbors.tolist()}


@pytest.mark.parametrize("change", [lambda mesh: mesh, changes.split, changes.refined])
def test_a_box_has_six_sides_and_twelve_convex_edges(change):
    surface = graph_of(change(shapes.box()))
    assert surface.n_polygons == 6
    assert surface.areas == pytest.approx(np.ones(6))
    assert surface.normals == pytest.approx(2 * (surface.centers - 0.5))
    assert len(edges_of(surface)) == 12
    assert surface.bends == pytest.approx(np.full(len(surface.bends), -np.pi / 2))
    assert surface.lengths.sum() == pytest.approx(12)


def test_polygons_of_many_corners_count_as_one():
    mesh = shapes.l_prism()
    surface = graph_of(mesh)
    assert surface.n_polygons == 8
    assert surface.areas[0] == pytest.approx(7)
    assert surface.centers[0] == pytest.approx([9.5 / 7, 9.5 / 7, 1])
    assert surface.normals[0] == pytest.approx([0, 0, 1])
    assert len(edges_of(surface)) == 18


def test_bends_tell_creases_from_ridges_and_flats():
    surface = graph_of(shapes.l_shape())
    assert bend_at(surface, [2.25, 2.25, 0.5]) == pytest.approx(np.pi / 2)
    assert bend_at(surface, [6.75, 0.25, 0.5]) == pytest.approx(-np.pi / 2)
    assert bend_at(surface, [1, 4.5, 2]) == pytest.approx(0)
    assert (surface.bends > 1).sum() == 2


def test_bends_do_not_depend_on_which_neighbor_comes_first():
    surface = graph_of(shapes.l_shape())
    shuffled, polygons = changes.permuted(shapes.l_shape(), 4)
    other = graph_of(shuffled)
    pairs = polygons[surface.neighbors]
    mine = {frozenset(p): b for p, b in zip(pairs.tolist(), surface.bends, strict=True)}
    for pair, bend in zip(other.neighbors.tolist(), other.bends, strict=True):
        assert bend == pytest.approx(mine[frozenset(pair)])


@pytest.mark.parametrize("angle", [0.1, 1.0, 2.0])
def test_bends_are_the_angle_between_normals(angle):
    for turn in (angle, -angle):
        folded = [[0, 1, 0], [0, 0, 0], [-1, 0, 0], [-1, 1, 0]]
        folded += [[np.cos(turn), 0, np.sin(turn)], [np.cos(turn), 1, np.sin(turn)]]
        surface = graph_of(shapes.mesh_of(folded, [(0, 3, 2, 1), (0, 1, 4, 5)]))
        assert surface.bends == pytest.approx([turn])


def test_ridges_around_a_hole_are_no_creases():
    """The centers of both large faces are in the hole, in front of its walls."""
    full = np.ones((3, 3, 1), dtype=bool)
    full[1, 1] = False
    mesh = shapes.voxels(full)
    quads = graph_of(mesh)
    normals = quads.normals.round()
    planes = np.c_[normals, (quads.centers * normals).sum(axis=1)]
    _, sides = np.unique(planes, axis=0, return_inverse=True)
    surface = graph_of(replace(mesh, polygons=sides.ravel()[mesh.polygons]))
    assert surface.n_polygons == 10
    assert np.abs(surface.bends) == pytest.approx(np.full(40, np.pi / 2))
    assert (surface.bends > 0).sum() == 4
    assert surface.lengths[surface.bends > 0] == pytest.approx(np.ones(4))


def test_polygons_without_area_have_a_place_and_no_normal():
    mesh = shapes.mesh_of(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 5, 5]], [(0, 1, 2), (3, 3, 3)]
    )
    surface = graph_of(mesh)
    assert surface.areas.tolist() == [0.5, 0]
    assert surface.centers[1].tolist() == [5, 5, 5]
    assert surface.normals[1].tolist() == [0, 0, 0]


def test_shells_and_pieces_are_connected():
    boxes = shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1)))
    surface = graph_of(boxes)
    assert surface.shells().tolist() == [0] * 6 + [1] * 6
    labels = np.zeros(12, dtype=int)
    assert surface.pieces(labels, 0.0).tolist() == [0] * 6 + [1] * 6
    x = surface.normals[:, 0]
    labels = (np.abs(x) > 0.5).astype(int)
    # Of each box the two ends along x, and the ring between them.
    assert len(set(surface.pieces(labels, 0.0))) == 6


def test_borders_are_as_long_as_the_edges_between_labels():
    surface = graph_of(shapes.box(divisions=4))
    labels = (surface.centers[:, 0] > 0.5).astype(int)
    labels[surface.centers[:, 0] > 0.9] = 2
    borders = surface.borders(labels, 4).toarray()
    assert (borders == borders.T).all()
    assert borders[0, 1] == pytest.approx(4)
    assert borders[0, 2] == 0
    assert borders[1, 2] == pytest.approx(4)
    assert (borders.diagonal() == 0).all()
    assert not borders[3].any()


def test_labels_without_borders_are_alone():
    boxes = shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1)))
    surface = graph_of(boxes)
    labels = np.array([0] * 3 + [1] * 3 + [2] * 6)
    assert surface.alone(labels, 4).tolist() == [False, False, True, True]
    linked = replace(surface, links=np.array([[0, 6]]))
    assert linked.alone(labels, 4).tolist() == [False, False, False, True]


def test_areas_of_labels():
    surface = graph_of(shapes.box(divisions=2))
    labels = (surface.centers[:, 2] > 0.5).astype(int)
    assert surface.areas_of(labels) == pytest.approx([3, 3])


def test_links_connect_what_shares_no_edge():
    boxes = shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1)))
    surface = graph_of(boxes)
    linked = replace(surface, links=np.array([[0, 6]]))
    alike = np.zeros(12, dtype=int)
    assert len(set(surface.pieces(alike, 0.0))) == 2
    assert len(set(linked.pieces(alike, 0.0))) == 1
    assert len(set(linked.pieces(surface.shells(), 0.0))) == 2
    # Hardly a border, so that a speck joins what it has an edge in common with.
    border = linked.borders(surface.shells(), 2).toarray()[0, 1]
    assert 0 < border < 1e-9


def test_a_link_connects_no_speck():
    boxes = shapes.joined(shapes.box(divisions=4), shapes.box((1, 0, 0), (2, 1, 1)))
    surface = graph_of(boxes)
    for beside in (0, 95):  # the first in each of its edges, and the second
        labels = (np.arange(surface.n_polygons) >= 96).astype(int)
        labels[beside] = 1  # one face of the first box goes with the second
        linked = replace(surface, links=np.array([[beside, 96]]))
        assert len(set(linked.pieces(labels, 0.0))) == 2
        pieces = linked.pieces(labels, 0.5)
        assert len(set(pieces)) == 3
        assert (pieces == pieces[beside]).sum() == 1


def test_borders_may_have_a_price_below_zero():
    surface = graph_of(shapes.box())
    priced = replace(surface, lengths=-surface.lengths)
    labels = (surface.centers[:, 2] > 0.5).astype(int)
    gained = priced.borders(labels, 2).toarray()
    assert gained[0, 1] == pytest.approx(-surface.borders(labels, 2).toarray()[0, 1])


def test_pieces_that_are_kept_are_those_of_a_new_graph():
    boxes = shapes.joined(shapes.box(divisions=4), shapes.box((1, 0, 0), (2, 1, 1)))
    surface = replace(graph_of(boxes), links=np.array([[0, 96], [95, 97], [3, 99]]))
    rng = np.random.default_rng(0)
    tried = [rng.integers(n, size=surface.n_polygons) for n in (1, 2, 3, 300)]
    for firm_area in (0.0, 0.1, 0.5, 0.0):
        for labels in tried:
            anew = replace(surface).pieces(labels, firm_area)
            assert (surface.pieces(labels, firm_area) == anew).all()


@pytest.mark.parametrize("n_pairs", [0, 1, 5, 40, 400])
def test_components_are_those_of_blocks(n_pairs, monkeypatch):
    pairs = np.random.default_rng(n_pairs).integers(60, size=(n_pairs, 2))
    found = [components.components_at_once(pairs, 60)]
    monkeypatch.setattr(components, "_MOST_NODES", 7)
    found.append(run(components.components(pairs, 60)))
    assert (found[0] == found[1]).all()
    _, first = np.unique(found[0], return_index=True)
    assert (np.diff(first) > 0).all()


def test_edges_are_sorted_where_most_vertices_are_at_one_place(monkeypatch):
    """A speck beside a huge wall: ranges of places are empty."""
    speck = changes.moved(shapes.sphere(1), 1e-9)
    wall = changes.moved(shapes.box(), 1e3, offset=(5, 0, 0))
    mesh = shapes.joined(speck, wall)
    usual = run(edges.sort_edges(mesh))
    monkeypatch.setattr(edges, "_MOST_SIDES", 12)
    found = run(edges.sort_edges(replace(mesh)))
    assert (found.sides == usual.sides).all()
