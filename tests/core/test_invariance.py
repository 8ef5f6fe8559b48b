from dataclasses import replace

import changes
import numpy as np
import pytest
import shapes
from computed import graph_of, split_up
from definitions import agreement


def same_partition(found, other, areas, polygons=None):
    labels = other.labels if polygons is None else other.labels[polygons]
    assert found.n_parts == other.n_parts
    return agreement(found.labels, labels, areas) >= 0.97


@pytest.fixture(scope="module")
def table():
    mesh = shapes.table()
    return mesh, graph_of(mesh).areas


SAME = {"max_parts": 6}


def test_the_same_parts_after_a_rotation(decomposed, table):
    mesh, areas = table
    turned = changes.moved(mesh, rotation=changes.any_rotation(1), offset=(9, 2, 5))
    assert same_partition(decomposed(shapes.table), split_up(turned, **SAME), areas)


@pytest.mark.parametrize("scale", [1000.0, 0.001])
def test_the_same_parts_at_another_scale(decomposed, table, scale):
    mesh, areas = table
    found, scaled = (
        decomposed(shapes.table),
        split_up(changes.moved(mesh, scale), **SAME),
    )
    assert same_partition(found, scaled, areas)
    assert scaled.areas == pytest.approx(found.areas * scale**2, rel=0.03)
    assert scaled.areas.sum() == pytest.approx(areas.sum() * scale**2)


def test_the_same_parts_of_shuffled_faces(decomposed, table):
    mesh, areas = table
    shuffled, polygons = changes.permuted(mesh, 5)
    found = split_up(shuffled, **SAME)
    assert same_partition(decomposed(shapes.table), found, areas, polygons)


def test_the_same_parts_of_split_vertices(decomposed, table):
    mesh, areas = table
    found = split_up(changes.split(mesh), **SAME)
    assert same_partition(decomposed(shapes.table), found, areas)


def test_the_same_parts_of_an_inside_out_mesh_with_a_note(decomposed, table):
    mesh, areas = table
    found = split_up(changes.inside_out(mesh), **SAME)
    assert same_partition(decomposed(shapes.table), found, areas)
    assert len(found.notes) == 1
    assert "inside out" in found.notes[0]


def test_the_same_parts_of_a_finer_tessellation(decomposed):
    """Each triangle in four, each a polygon of its own."""
    mesh = shapes.l_shape()
    finer = changes.refined(mesh)
    finer = replace(finer, polygons=np.arange(len(finer.triangles)))
    coarse, fine = decomposed(shapes.l_shape), split_up(finer)
    assert coarse.n_parts == fine.n_parts
    labels = coarse.labels[np.repeat(mesh.polygons, 4)]
    assert agreement(labels, fine.labels, finer.areas) >= 0.9


def test_the_same_parts_of_triangles_for_polygons(decomposed, table):
    mesh, _ = table
    triangles = replace(mesh, polygons=np.arange(len(mesh.triangles)))
    found = split_up(triangles, **SAME)
    labels = decomposed(shapes.table).labels[mesh.polygons]
    assert agreement(labels, found.labels, mesh.areas) >= 0.97


def test_a_crate_of_twelve_triangles_is_a_crate_of_many_quads():
    coarse = shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1)))
    fine = shapes.joined(
        shapes.box(divisions=3), shapes.box((3, 0, 0), (4, 1, 1), divisions=3)
    )
    found = [split_up(mesh, parts=2) for mesh in (coarse, fine)]
    for mesh, decomposition in zip((coarse, fine), found, strict=True):
        left = graph_of(mesh).centers[:, 0] < 2
        assert len(set(decomposition.labels[left])) == 1
        assert len(set(decomposition.labels[~left])) == 1
    assert found[0].areas == pytest.approx(found[1].areas)


@pytest.mark.parametrize(
    ("make", "parts"),
    [
        (shapes.l_shape, 0),
        (shapes.l_shape, 8),
        (shapes.box, 4),
        (lambda: shapes.box(divisions=3), 4),
        (lambda: shapes.sphere(1), 3),
        (lambda: shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1))), 0),
        (lambda: shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1))), 5),
    ],
    ids=["L", "L in 8", "box", "fine box", "sphere", "two", "two in 5"],
)
def test_the_same_seed_gives_the_same_labels(make, parts):
    first = split_up(make(), parts=parts, samples=100)
    split_up(shapes.l_prism(), samples=50)
    second = split_up(make(), parts=parts, samples=100)
    assert (first.labels == second.labels).all()
    assert (first.psi, first.psi_by_k) == (second.psi, second.psi_by_k)
