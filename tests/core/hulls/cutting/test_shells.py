"""Objects of several shells, such as boards that run through each other."""

import changes
import numpy as np
import pytest
import shapes
from computed import build_hulls, solid_of
from weak_convex_decomposition.core.hulls.cutting.cell import whole
from weak_convex_decomposition.core.hulls.cutting.shells import shells_of
from weak_convex_decomposition.core.hulls.fitting import Fit
from weak_convex_decomposition.core.hulls.piece import BURIED, join
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.steps.progress import run

POSTS = [shapes.box((x, 0, 0), (x + 1, 0.3, 10)) for x in range(0, 24, 3)]
RAILS = [shapes.box((-1, 0.1, z), (23, 0.4, z + 1)) for z in (2, 7)]
FENCE = shapes.joined(*POSTS, *RAILS)
HAMMER = [shapes.box((-1, -1, -6), (1, 1, 1)), shapes.box((-3, -1.5, -1), (3, 1.5, 2))]


def cell_of(*meshes):
    """Return meshes, joined, as the whole to cut."""
    mesh = shapes.joined(*meshes)
    unit = np.ptp(mesh.bounds, axis=0).max() / 2
    solid = solid_of(changes.moved(mesh, scale=1 / unit))
    return whole(solid, Fit(HullParameters(), 1.0, 0.05))


def without_lower_ends(mesh):
    """Return boards without the faces at their lower ends."""
    return changes.without(mesh, lambda at: at[:, 2] < 0.1)


@pytest.mark.parametrize(
    ("kind", "max_error"), [("HULL", 0.05), ("HULL", 0.002), ("BOX", 0.05)]
)
def test_a_fence_gets_a_hull_for_each_board(kind, max_error):
    """It once got 27 hulls within 0.05, as planes beside a board run through others."""
    found = build_hulls(FENCE, HullParameters(shape=kind, max_error=max_error))
    volumes = sorted(shape.volume for shape in found.shapes)
    assert volumes == pytest.approx([3] * 8 + [7.2] * 2, rel=1e-4)
    assert found.errors.max() < 1e-6


@pytest.mark.parametrize(("max_hulls", "most"), [(3, 0.5), (6, 1e-6)])
def test_a_number_of_hulls_is_kept(max_hulls, most):
    mesh = shapes.joined(*POSTS[:4], *RAILS)
    found = build_hulls(mesh, HullParameters(max_hulls=max_hulls, max_error=0.01))
    assert found.n_hulls == max_hulls
    assert found.errors.max() < most


def test_boards_may_be_open_where_nobody_looks():
    boards = [*map(without_lower_ends, POSTS), *RAILS]
    found = build_hulls(shapes.joined(*boards), HullParameters())
    assert found.n_hulls == 10


def test_shells_that_are_not_convex_are_cut():
    """An angle runs through a channel: cuts of the whole once gave six hulls."""
    sides = ((0, 1), (0, 12), (0, 12)), ((11, 12), (0, 12), (0, 12))
    channel = shapes.blocks((12, 12, 12), ((0, 12), (0, 12), (0, 1)), *sides)
    legs = ((0, 24), (0, 4), (0, 2)), ((0, 2), (0, 4), (0, 24))
    angle = changes.moved(shapes.blocks((24, 4, 24), *legs), offset=(-4.3, 3.4, 5.4))
    found = build_hulls(shapes.joined(channel, angle), HullParameters())
    assert found.n_hulls == 5


def test_a_shell_within_another_gets_no_hull():
    inner = shapes.box((-0.9, -0.9, -5), (0.9, 0.9, 0))
    found = build_hulls(shapes.joined(*HAMMER, inner), HullParameters())
    assert found.n_hulls == 2


def test_shells_have_their_own_volume_and_surface():
    cell = cell_of(*HAMMER)
    head, handle = run(shells_of(cell, 2))
    for piece, volume in ((handle, 28), (head, 54)):
        assert piece.volume == pytest.approx(volume / 4**3, rel=0.05)
        assert piece.is_close
        assert (piece.triangles == BURIED).any()
    joint = join(handle, head)
    assert joint.volume == pytest.approx(cell.volume, rel=1e-3)
    assert not (joint.triangles == BURIED).any()


def test_cavities_belong_to_the_shell_around_them():
    hollow = shapes.hollow_sphere()
    cell = cell_of(hollow, shapes.box((-2, -0.1, -0.1), (2, 0.1, 0.1)))
    ball, rod = sorted(run(shells_of(cell, 3)), key=lambda piece: -len(piece.faces))
    assert len(ball.faces) == len(hollow.triangles)
    assert len(rod.faces) == 12
    assert ball.volume == pytest.approx(7 / 8 * 4 / 3 * np.pi / 8, rel=0.07)


def test_many_shells_are_no_start():
    assert run(shells_of(cell_of(FENCE), 9)) == []
    assert len(run(shells_of(cell_of(FENCE), 10))) == 10
    assert run(shells_of(cell_of(shapes.u_shape()), 10)) == []
