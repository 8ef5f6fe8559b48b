"""Patches of a mesh of many faces, and parts that are found on them."""

from functools import cache

import numpy as np
import pytest
import shapes
from computed import graph_of, prepare
from definitions import agreement
from weak_convex_decomposition.core.geometry.graphs.patches import (
    contracted,
    find_patches,
)
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts import part_memo
from weak_convex_decomposition.core.parts.find import find_parts
from weak_convex_decomposition.core.sight.visibility import see_in_steps
from weak_convex_decomposition.core.steps.progress import run

PARAMETERS = Parameters(samples=150, max_parts=6)


@cache
def dumbbell():
    """Return a dumbbell of some 1,900 faces, and its visibility."""
    mesh = shapes.blocks(
        (36, 12, 12), ((0, 12), (0, 12), (0, 12)), ((24, 36), (0, 12), (0, 12)),
        ((12, 24), (4, 8), (4, 8)),
    )  # fmt: skip
    shape = prepare(mesh)
    return shape, run(see_in_steps(shape, PARAMETERS))


@cache
def patches_of_dumbbell():
    return run(find_patches(dumbbell()[0].graph, 300))


def found_with(most_nodes):
    """Return the parts of the dumbbell, with patches if it has more nodes."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(part_memo, "_MOST_NODES", most_nodes)
        return run(find_parts(part_memo.PartMemo(dumbbell()[1]), PARAMETERS))


def test_patches_are_connected_and_about_as_many_and_as_large_as_asked_for():
    patches = patches_of_dumbbell()
    graph, n_patches = patches.fine, len(patches.coarse.areas)
    assert set(patches.of_nodes) == set(range(n_patches))
    assert len(set(graph.pieces(patches.of_nodes, 0.0))) == n_patches
    assert 200 < n_patches < 450
    shares = patches.coarse.areas / graph.areas.sum() * 300
    assert shares.min() > 0.25
    assert shares.max() < 3


def test_patches_end_at_sharp_edges():
    patches = patches_of_dumbbell()
    graph = patches.fine
    sharp = np.abs(graph.bends) > 1
    pairs = patches.of_nodes[graph.neighbors[sharp]]
    assert sharp.any()
    assert (pairs[:, 0] != pairs[:, 1]).all()


def test_patches_are_the_same_every_time():
    again = run(find_patches(dumbbell()[0].graph, 300))
    assert (again.of_nodes == patches_of_dumbbell().of_nodes).all()


def test_a_surface_of_sharp_edges_alone_has_patches_too():
    mesh = shapes.box(divisions=24)
    random = np.random.default_rng(0)
    rough = mesh.vertices + random.normal(scale=0.05, size=mesh.vertices.shape)
    graph = graph_of(type(mesh)(rough, mesh.triangles, mesh.polygons))
    patches = run(find_patches(graph, 200))
    assert len(patches.coarse.areas) < 600


def test_patches_keep_areas_and_the_cost_of_seams():
    patches = patches_of_dumbbell()
    fine, coarse = patches.fine, patches.coarse
    assert coarse.areas.sum() == pytest.approx(fine.areas.sum())
    assert np.linalg.norm(coarse.normals, axis=1) == pytest.approx(1)
    left = (coarse.centers[:, 0] < 0).astype(int)
    assert cost(coarse, left) == pytest.approx(cost(fine, left[patches.of_nodes]))
    assert cost(coarse, left) > 0


def cost(graph, labels):
    """Return the cost of all seams."""
    ends = labels[graph.neighbors]
    return graph.seam_costs[ends[:, 0] != ends[:, 1]].sum()


def test_nodes_without_area_are_contracted():
    graph = graph_of(
        shapes.mesh_of([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [(0, 1, 2), (2, 1, 1)])
    )
    one = run(contracted(graph, np.array([0, 1])))
    assert np.isfinite(one.centers).all()
    assert one.areas.tolist() == [0.5, 0.0]


def test_opened_patches_are_their_nodes():
    patches = patches_of_dumbbell()
    nothing = np.zeros(len(patches.coarse.areas), dtype=bool)
    graph, places = run(patches.opened(nothing))
    assert (places == patches.of_nodes).all()
    assert graph.lengths.sum() == pytest.approx(patches.coarse.lengths.sum())
    graph, places = run(patches.opened(~nothing))
    assert sorted(places) == list(range(patches.fine.n_polygons))
    assert graph.areas[places] == pytest.approx(patches.fine.areas)
    assert len(graph.neighbors) == len(patches.fine.neighbors)


def test_parts_on_patches_are_those_on_faces_but_for_seams():
    areas = dumbbell()[0].graph.areas
    on_faces, on_patches = found_with(10_000), found_with(600)
    assert on_patches.n_parts == on_faces.n_parts > 1
    # A row of faces along a seam has about 1 % of the area.
    assert agreement(on_patches.labels, on_faces.labels, areas) > 0.98
    assert on_patches.areas.sum() == pytest.approx(on_faces.areas.sum())
    assert (on_patches.face_counts == np.bincount(on_patches.labels)).all()


def test_seams_follow_edges_of_faces_and_leave_no_specks():
    found, graph = found_with(600), dumbbell()[0].graph
    assert len(set(graph.pieces(found.labels, 0.0))) == found.n_parts


def test_parts_on_patches_are_the_same_every_time():
    assert (found_with(600).labels == found_with(600).labels).all()


def test_a_mesh_of_few_faces_has_no_patches():
    memo = part_memo.PartMemo(dumbbell()[1])
    run(memo.transfer_in_steps())
    assert memo.patches is None
