"""Triangles on top of each other."""

from dataclasses import replace

import large_shapes
import numpy as np
import pytest
import shapes
from computed import decompose, measure, prepare
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.solids import doubled
from weak_convex_decomposition.core.solids.doubled import with_doubles
from weak_convex_decomposition.core.steps.progress import run

BOX = shapes.box()


def without_doubles(mesh):
    return run(doubled.without_doubles(mesh))


def test_a_mesh_without_doubles_stays_itself():
    single, rows = without_doubles(BOX)
    assert single is BOX
    assert rows.tolist() == list(range(len(BOX.triangles)))


@pytest.mark.parametrize(
    "double", [large_shapes.copies, large_shapes.with_doubled_faces]
)
def test_one_of_all_equal_triangles_is_left(double):
    single, rows = without_doubles(double(BOX))
    assert single.triangles.tolist() == BOX.triangles.tolist()
    assert rows.tolist() == 2 * list(range(len(BOX.triangles)))


def test_triangles_may_begin_at_any_corner_but_not_turn_over():
    rolled = replace(BOX, triangles=np.roll(BOX.triangles, 1, axis=1))
    assert len(without_doubles(shapes.joined(BOX, rolled))[0].triangles) == 12
    turned = replace(BOX, triangles=BOX.triangles[:, ::-1])
    assert len(without_doubles(shapes.joined(BOX, turned))[0].triangles) == 24


def test_doubles_turn_with_the_triangle_that_is_left():
    mesh = large_shapes.copies(BOX)
    single, rows = without_doubles(mesh)
    turned = replace(single, triangles=single.triangles[:, ::-1])
    both = with_doubles(mesh, turned, rows)
    assert both.normals == pytest.approx(-mesh.normals)
    assert both.polygons.tolist() == mesh.polygons.tolist()


@pytest.mark.parametrize(
    "double", [large_shapes.copies, large_shapes.with_doubled_faces]
)
def test_doubled_faces_have_the_parts_of_single_ones(double):
    mesh = shapes.dumbbell()
    parameters = Parameters(samples=150)
    labels = decompose(double(mesh), parameters).labels.reshape(2, -1)
    assert labels[0].tolist() == labels[1].tolist()
    once = decompose(replace(mesh, polygons=np.arange(len(mesh.triangles))), parameters)
    assert labels.max() + 1 == once.n_parts


def test_doubled_faces_hide_nothing():
    shape = prepare(large_shapes.copies(shapes.sphere(1), 3))
    assert len(shape.targets.triangles) == 80
    assert shape.n_nodes == 240
    assert shape.marcher.closed.all()


@pytest.mark.parametrize("count", [1, 2, 3, 12])
def test_some_triangles_of_a_convex_mesh_may_be_doubled(count):
    cube = shapes.box()
    triangles = np.concatenate([cube.triangles, cube.triangles[:count]])
    mesh = TriangleMesh(cube.vertices, triangles, np.arange(12 + count))
    assert measure(mesh, Parameters(samples=100)).rank == 1.0
