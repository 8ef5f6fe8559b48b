"""Triangles without area, as booleans leave them: they close shells, and part none."""

from dataclasses import replace
from itertools import pairwise

import changes
import large_shapes
import numpy as np
import pytest
import shapes
from computed import build_hulls, decompose, prepare, shells_of
from weak_convex_decomposition import HullParameters, Parameters
from weak_convex_decomposition.core.geometry.graphs.edges import sort_edges
from weak_convex_decomposition.core.solids.convexity import is_convex
from weak_convex_decomposition.core.solids.mass import mass_of_mesh
from weak_convex_decomposition.core.solids.slivers import solid_edges
from weak_convex_decomposition.core.steps.progress import run

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
CUBE = [(x, y, z) for z in (0, 1) for x, y in SQUARE]
SIDES = [(3, 2, 1, 0), (4, 5, 6, 7), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
# The side y = 0 has the corners 0, 1, 5, 4; its edge from 0 to 1 is that of the floor.


def with_zero_length_edge():
    """Return the cube with an edge of length 0 between two triangles at its corner."""
    return shapes.mesh_of(
        [*CUBE, CUBE[0]],
        [(3, 2, 1, 8), *SIDES[1:4], (3, 8, 0, 4, 7), (0, 8, 1), (0, 1, 5, 4)],
    )


def with_t_junction(places=(0.5,)):
    """Return the cube with corners along an edge of one side, and slivers there.

    The other side of the edge knows nothing of the corners. The slivers between make a
    fan.
    """
    corners = [8 + i for i in range(len(places))]
    slivers = [(1, after, before) for before, after in pairwise([0, *corners])]
    vertices = [*CUBE, *((x, 0, 0) for x in places)]
    return shapes.mesh_of(vertices, [*SIDES, *slivers, (4, 0, *corners, 1, 5)])


CLOSED = {
    "zero-length edge": with_zero_length_edge,
    "T-junction": with_t_junction,
    "chain": lambda: with_t_junction((0.2, 0.4, 0.6, 0.8)),
    "loose point": lambda: shapes.joined(
        shapes.box(), shapes.mesh_of([(0.5, 0.5, 2.0)] * 3, [(0, 1, 2)])
    ),
}
ONE_SHELL = [name for name in CLOSED if name != "loose point"]


def turned(mesh):
    return changes.moved(mesh, rotation=changes.any_rotation(1), offset=(3, 1, 2))


@pytest.mark.parametrize("change", [lambda mesh: mesh, changes.split, turned])
@pytest.mark.parametrize("name", ONE_SHELL)
def test_a_cube_with_slivers_is_one_closed_shell(name, change):
    shells = shells_of(change(CLOSED[name]()))
    assert shells.closed.tolist() == [True]
    assert not shells.against.any()


@pytest.mark.parametrize("name", CLOSED)
def test_nothing_is_said_of_slivers(name):
    prepared = prepare(CLOSED[name]())
    assert prepared.notes == ()
    assert prepared.marcher.closed.all()


@pytest.mark.parametrize("name", CLOSED)
def test_a_cube_inside_out_is_turned_with_its_slivers(name):
    prepared = prepare(changes.inside_out(CLOSED[name]()))
    assert "inside out" in prepared.notes[0]
    assert mass_of_mesh(prepared.solid, 1.0).mass > 0


@pytest.mark.parametrize("name", ["zero-length edge", "T-junction", "chain"])
def test_a_cube_with_slivers_is_convex(name):
    mesh = CLOSED[name]()
    assert run(is_convex(mesh, shells_of(mesh)))


@pytest.mark.parametrize("name", ONE_SHELL)
def test_parts_and_hulls_are_those_without_slivers(name):
    mesh = CLOSED[name]()
    assert decompose(mesh, Parameters(samples=200)).n_parts == 1
    found = build_hulls(mesh, HullParameters())
    assert found.n_hulls == 1
    assert found.errors.max() < 1e-3


def test_a_turned_sliver_makes_no_note():
    """A sliver against a consistent cube, which all its neighbors pair with."""
    mesh = with_t_junction()
    thin = mesh.polygons == len(SIDES)
    wrong = replace(
        mesh,
        triangles=np.where(thin[:, None], mesh.triangles[:, ::-1], mesh.triangles),
    )
    assert thin.sum() == 1
    assert prepare(wrong).notes == ()


def test_cubes_that_touch_at_slivers_stay_apart():
    """Two cubes with the same edge, corners and slivers there."""
    cube = with_t_junction((0.3, 0.6))
    half_turn = np.diag([1.0, -1.0, -1.0])
    both = shapes.joined(cube, changes.moved(cube, rotation=half_turn))
    shells = shells_of(both)
    solid = np.isin(both.polygons % cube.n_polygons, range(len(SIDES)))
    owners = both.polygons // cube.n_polygons
    assert shells.closed.tolist() == [True, True]
    assert (shells.of_triangle == owners)[solid].all()


def test_collapsed_triangles_connect_no_shells():
    """A wire of them between two cubes."""
    far = changes.moved(shapes.box(), offset=(3, 0, 0))
    ends = [(1, 0, 0), (1, 0, 0), (2, 0, 0), (2, 0, 0), (3, 0, 0), (3, 0, 0)]
    wire = shapes.mesh_of(ends, [(0, 1, 2), (2, 3, 4), (4, 5, 4)])
    shells = shells_of(shapes.joined(shapes.box(), far, wire))
    assert shells.closed.tolist() == [True, True]


@pytest.mark.parametrize(
    "mesh",
    [shapes.box(), shapes.sheet(), large_shapes.with_doubled_faces(shapes.box())],
)
def test_edges_of_other_meshes_stay_as_they_are(mesh):
    found, left_out = run(solid_edges(mesh))
    assert found is run(sort_edges(mesh))
    assert not left_out.any()


def test_needles_are_taken_as_they_are():
    """All triangles of a very thin bar have two corners at one place."""
    bar = shapes.box((0, 0, 0), (1e-7, 1e-7, 1))
    assert shells_of(bar).windable.all()
    assert decompose(bar, Parameters(samples=200)).n_parts >= 1
