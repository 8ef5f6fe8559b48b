"""Open meshes of single faces, whose walls have no thickness."""

import changes
import numpy as np
import pytest
import shapes
from computed import build_hulls, solid_of
from weak_convex_decomposition.core.hulls.cutting.cell import whole
from weak_convex_decomposition.core.hulls.cutting.plane_directions import directions_of
from weak_convex_decomposition.core.hulls.fitting import Fit
from weak_convex_decomposition.core.parameters.hulls import HullParameters

# A room of 4 × 3 × 2.6 without its front, and one with a door in it.
SIDES = [(0, 3, 2, 1), (4, 5, 6, 7), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
FRONT = [(0, 8, 11, 4), (11, 10, 5, 4), (9, 1, 5, 10)]
PLACES = [(x, y, z) for z in (0, 2.6) for x, y in ((0, 0), (4, 0), (4, 3), (0, 3))]
FIT = Fit(HullParameters(), 1.0, 0.05)
DOOR = [(1.5, 0, 0), (2.4, 0, 0), (2.4, 0, 2.1), (1.5, 0, 2.1)]


def room(front=(), inwards=False):
    """Return the walls of a room as single faces."""
    faces = [face[::-1] if inwards else face for face in (*SIDES, *front)]
    return shapes.mesh_of(PLACES + DOOR, faces)


@pytest.mark.parametrize(
    ("make", "most"),
    [
        (room, 5),
        (lambda: room(inwards=True), 5),
        (lambda: room(FRONT), 8),
        (lambda: shapes.open_box(1), 5),
        (shapes.open_box, 5),
    ],
    ids=["room", "inwards", "door", "box", "box of many faces"],
)
def test_walls_are_plates(make, most):
    """Rooms once got 31 and 32 hulls, which strayed by 0.65."""
    found = build_hulls(make(), HullParameters())
    assert found.n_hulls <= most
    assert found.errors.max() <= 0.05


@pytest.mark.parametrize(("front", "most"), [((), 5), (FRONT, 8)])
@pytest.mark.parametrize("seed", [1, 2])
def test_how_walls_are_turned_does_not_matter(front, most, seed):
    """Walls with a door were once cut along any axes, and got five hulls."""
    turned = changes.moved(room(front), rotation=changes.any_rotation(seed))
    found = build_hulls(turned, HullParameters())
    assert found.n_hulls == most
    assert found.errors.max() <= 0.05


def test_plates_are_not_cut_along_themselves():
    """Both sides would be the same plate: a wall with a hole once got 32 hulls."""
    cell = whole(solid_of(shapes.sheet()), FIT)
    directions, _ = directions_of(cell)
    assert len(directions) > 1
    assert np.abs(directions[:, 2]).max() < 0.1


def test_plates_are_cut_along_their_straight_sides():
    turn = changes.any_rotation(3)
    cell = whole(solid_of(changes.moved(shapes.sheet(), rotation=turn)), FIT)
    directions, is_block = directions_of(cell)
    assert is_block
    along = np.sort(np.abs(directions @ turn), axis=0)
    assert along == pytest.approx(np.array([[0, 0, 0], [1, 1, 0]]), abs=1e-6)


def test_a_solid_with_a_small_hole_stays_solid():
    arms = ((0, 28), (0, 8), (0, 8)), ((0, 8), (0, 28), (0, 8))
    hole = np.array([20.5, 4.5, 8])
    mesh = changes.without(
        shapes.blocks((28, 28, 8), *arms), lambda at: (at == hole).all(axis=1)
    )
    found = build_hulls(mesh, HullParameters())
    assert found.n_hulls == 2
    assert found.volume_ratio == pytest.approx(1, abs=0.01)


def test_faces_without_area_are_no_wall():
    """Their corners lie anywhere, and a hull of them would be thick."""
    walls = shapes.open_box(1)
    line = shapes.mesh_of([(0, 0, 0), (0.5, 0.5, 0.5), (1, 1, 1)], [(0, 1, 2)])
    found = build_hulls(shapes.joined(walls, line), HullParameters())
    assert found.n_hulls == 5
