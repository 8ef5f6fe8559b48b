"""What of a surface lies within a collision shape."""

import changes
import numpy as np
import pytest
import shapes
from computed import build_hulls, solid_of
from weak_convex_decomposition.core.hulls.convex_hull import THIN, convex_hull
from weak_convex_decomposition.core.hulls.fitting import fit_for
from weak_convex_decomposition.core.hulls.measure.surface_within import surface_within
from weak_convex_decomposition.core.parameters.hulls import HullParameters


@pytest.mark.parametrize(("kind", "area"), [("HULL", 0.5), ("SPHERE", np.pi / 4)])
def test_triangles_at_the_rim_are_clipped(kind, area):
    mesh = shapes.sheet(2)  # 1 x 1
    solid = solid_of(mesh)
    middle = solid.vertices.mean(axis=0)
    # An octahedron, which meets the sheet in a square, or the ball around it.
    corners = middle + np.concatenate([np.eye(3), -np.eye(3)]) / 2
    fit, _ = fit_for(mesh, HullParameters(shape=kind), 1.0)
    shape = fit.shape(convex_hull(corners, THIN))
    found = surface_within(solid, shape)
    a, b, c = np.moveaxis(found, 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    assert areas.sum() == pytest.approx(area, rel=0.03)
    assert shape.heights(found.reshape(-1, 3)).max() <= THIN / 5


CUBE = shapes.box((0, 0, 0), (4, 4, 4))
# Boxes within a cube, through its face, and through all of it; the area of the union,
# the number of hulls, and their volumes over that of the union.
BURIED = {
    "within": (shapes.box((1, 1, 1), (2, 2, 2)), 96.0, 1, 1.0),
    "face": (shapes.box((1, 1, 3), (2, 2, 6)), 96.0 + 8, 2, 67 / 66),
    "across": (shapes.box((-2, 1, 1), (6, 2, 2)), 96.0 + 16, 2, 72 / 68),
}


def test_a_solid_alone_keeps_its_surface():
    for mesh in (CUBE, shapes.hollow_sphere(0.5, 1), shapes.open_box()):
        solid = solid_of(mesh)
        assert solid.surface is solid.mesh
        assert len(solid.samples) == 6000


@pytest.mark.parametrize("seed", [None, 1])
@pytest.mark.parametrize("name", BURIED)
def test_what_is_buried_in_another_solid_is_no_surface(name, seed):
    mesh, area = shapes.joined(CUBE, BURIED[name][0]), BURIED[name][1]
    rotation = None if seed is None else changes.any_rotation(seed)
    scale = 2 / np.ptp(mesh.vertices, axis=0).max()
    solid = solid_of(changes.moved(mesh, scale, rotation))
    # Fragments beside the other surface stay.
    assert 0.9999 * area < solid.surface.areas.sum() / scale**2 < 1.02 * area
    original = (solid.samples / scale) @ (np.eye(3) if seed is None else rotation)
    grain = 0.01 / scale
    within_cube = ((original > grain) & (original < 4 - grain)).all(axis=1)
    assert not within_cube.any()
    assert len(solid.samples) == 6000


@pytest.mark.parametrize("name", BURIED)
def test_hulls_of_a_union_ignore_what_is_buried(name):
    mesh, _, number, ratio = BURIED[name]
    found = build_hulls(shapes.joined(CUBE, mesh), HullParameters())
    assert found.n_hulls == number
    assert found.errors.max() < 1e-3
    assert found.volume_ratio == pytest.approx(ratio, abs=0.01)


def turned_box(side, center, seed):
    mesh = shapes.box((-side / 2,) * 3, (side / 2,) * 3)
    return changes.moved(mesh, 1, changes.any_rotation(seed), center)


INNER = shapes.box((1, 1, 1), (3, 3, 3))
HALVES = [shapes.box((0, 0, 0), (2.05, 4, 4)), shapes.box((1.95, 0, 0), (4, 4, 4))]
BAR = shapes.box((1, 1.5, 1.5), (3, 2.5, 2.5))
# Solids that make up a cube: what is in it runs into each other, too.
DEEP = {
    "small": [CUBE, shapes.box((1.9, 1.9, 1.9), (2.2, 2.2, 2.2))],
    "crossing": [CUBE, turned_box(1.4, (2, 2, 2), 2), turned_box(1.2, (2.3, 2, 2), 3)],
    "flush": [CUBE, shapes.box((1, 1, 1), (2, 3, 3)), shapes.box((2, 1, 1), (3, 3, 3))],
    "twice": [CUBE, INNER, changes.refined(INNER)],
    "halves": [*HALVES, BAR],
}


@pytest.mark.parametrize("name", DEEP)
def test_a_cube_of_many_solids_is_one_hull(name):
    mesh = shapes.joined(*DEEP[name])
    found = build_hulls(mesh, HullParameters())
    assert found.n_hulls == 1
    assert found.errors.max() <= 0.05
    solid = solid_of(changes.moved(mesh, 0.5))
    assert solid.surface.areas.sum() == pytest.approx(96 / 4, rel=0.03)


@pytest.mark.parametrize("low", [0, 1])
def test_faces_that_lie_on_each_other_are_not_cut_up(low):
    """A box in the corner of a larger one, and one that leaves it beside that."""
    box = shapes.box((low, low, 0), (low + 2, low + 2, 1.5))
    mesh = shapes.joined(shapes.box((0, 0, 0), (2, 2, 2)), box)
    solid = solid_of(changes.moved(mesh, 1 if low == 0 else 2 / 3))
    assert len(solid.surface.triangles) < 20_000


def test_a_cavity_and_what_is_in_it_are_surface():
    core = shapes.sphere(2, 0.2)
    solid = solid_of(shapes.joined(shapes.hollow_sphere(0.5, 2), core))
    assert solid.surface is solid.mesh
    bar = shapes.box((-2, -0.1, -0.1), (2, 0.1, 0.1))
    mixed = shapes.joined(shapes.hollow_sphere(0.5, 2), bar)
    solid = solid_of(changes.moved(mixed, 0.5))
    radii = 2 * np.linalg.norm(solid.samples, axis=1)
    assert (np.abs(radii - 0.5) < 0.03).any()  # the wall of the cavity
    of_bar = solid.triangles >= len(mixed.triangles) - 12
    assert (radii[of_bar] < 0.45).any()  # in the cavity, the bar is surface
    assert not ((radii[of_bar] > 0.53) & (radii[of_bar] < 0.9)).any()
