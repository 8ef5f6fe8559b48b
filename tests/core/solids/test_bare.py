"""Triangles on top of each other."""

from dataclasses import replace

import large_shapes
import numpy as np
import pytest
import shapes
from computed import decompose, measure, prepare
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.solids.bare import bare_mesh
from weak_convex_decomposition.core.steps.progress import run

BOX = shapes.box()


def bare(mesh):
    return run(bare_mesh(mesh))


def test_a_mesh_without_doubles_stays_itself():
    assert bare(BOX).mesh is BOX
    assert bare(BOX).rows.tolist() == list(range(len(BOX.triangles)))
    assert bare(BOX).wound_as(BOX) is BOX


@pytest.mark.parametrize(
    "double", [large_shapes.copies, large_shapes.with_doubled_faces]
)
def test_one_of_all_equal_triangles_is_left(double):
    found = bare(double(BOX))
    assert found.mesh.triangles.tolist() == BOX.triangles.tolist()
    assert found.rows.tolist() == 2 * list(range(len(BOX.triangles)))
    assert found.notes == ()


def test_triangles_may_begin_at_any_corner_but_not_turn_over():
    rolled = replace(BOX, triangles=np.roll(BOX.triangles, 1, axis=1))
    assert len(bare(shapes.joined(BOX, rolled)).mesh.triangles) == 12
    turned = replace(BOX, triangles=BOX.triangles[:, ::-1])
    assert len(bare(shapes.joined(BOX, turned)).mesh.triangles) == 24


def test_doubles_turn_with_the_triangle_that_is_left():
    mesh = large_shapes.copies(BOX)
    found = bare(mesh)
    turned = replace(found.mesh, triangles=found.mesh.triangles[:, ::-1])
    both = found.wound_as(turned)
    assert both.normals == pytest.approx(-mesh.normals)
    assert both.polygons.tolist() == mesh.polygons.tolist()
    assert found.without_walls(both) is both


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
