import changes
import numpy as np
import pytest
import shapes
from computed import decompose, marcher_of, measure
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.sight.containers import see_through
from weak_convex_decomposition.core.sight.enclosed import find_enclosed
from weak_convex_decomposition.core.steps.progress import run


def grid_of(mesh):
    return run(find_enclosed(marcher_of(mesh)))


def seen_through(mesh, starts, ends):
    starts, ends = np.atleast_2d(starts).astype(float), np.atleast_2d(ends)
    places, rows = np.concatenate([starts, ends]), np.arange(len(starts))
    return run(see_through(grid_of(mesh), places, rows, rows + len(rows))).tolist()


@pytest.mark.parametrize(
    "make", [shapes.box, shapes.l_prism, shapes.sheet, lambda: shapes.sphere(1)]
)
def test_shapes_without_a_hollow_enclose_nothing(make):
    assert grid_of(make()) is None


@pytest.mark.parametrize("wall", [0.02, 0.1, 0.2])
def test_a_cup_is_seen_through_from_wall_to_wall(wall):
    cup = shapes.cup(wall)
    starts = [[wall, 0.5, 0.5], [wall, 0.5, 0.9], [0.5, 0.5, wall], [0, 0.5, 0.5]]
    ends = [[1 - wall, 0.5, 0.5], [1 - wall, 0.4, 0.5], [wall, 0.5, 0.7], [1, 0.5, 0.4]]
    assert seen_through(cup, starts, ends) == [True] * 4


def test_nothing_is_seen_through_the_open():
    outer = np.array([[0, 0.5, 0.5], [0.5, 0, 0.5]])
    pair = shapes.joined(shapes.cup(), changes.moved(shapes.cup(), offset=(3, 0, 0)))
    # From one cup to the other, and past the corner of one.
    assert seen_through(pair, outer, outer + np.array([4, 0, 0])) == [False] * 2
    assert seen_through(shapes.cup(), [-0.5, 0.5, 0.5], [0.5, -0.5, 0.5]) == [False]


def test_a_cavity_is_enclosed_however_the_shape_lies():
    assert grid_of(shapes.hollow_sphere(0.5, 1)) is not None
    turned = changes.moved(shapes.cup(), rotation=changes.any_rotation(3))
    assert grid_of(turned) is not None


def test_a_gap_between_two_plates_is_open():
    plate = shapes.box(high=(1, 1, 0.05))
    plates = shapes.joined(plate, changes.moved(plate, offset=(0, 0, 1)))
    assert grid_of(plates) is None


@pytest.mark.parametrize(
    "values", [{}, {"sight": "CONE"}, {"sight": "CONE", "psi_pairs": "RAYS"}]
)
def test_a_cup_stays_whole(values):
    mesh = changes.refined(shapes.cup())
    values = {"samples": 300, "max_parts": 6, **values}
    found = decompose(mesh, Parameters(**values))
    assert found.n_parts == 1
    # Ranks are those of eq. 1: the hollow is not of the solid.
    assert found.ranks[0] < 0.5 < found.psi_before
    hollow = Parameters(**values, containers="HOLLOW")
    assert decompose(mesh, hollow).n_parts > 1


def test_measuring_knows_no_containers():
    ranks = [
        measure(shapes.cup(), Parameters(samples=200, containers=choice)).rank
        for choice in ("FILLED", "HOLLOW")
    ]
    assert ranks[0] == ranks[1] < 0.5


def test_the_gap_between_touching_boxes_is_no_container():
    """The middle of the grid's cells lies in it."""
    stack = [shapes.box((0, 0, low), (1, 1, low + 1)) for low in range(8)]
    parameters = Parameters(samples=200, containers="FILLED")
    found = decompose(shapes.joined(*stack), parameters)
    assert found.psi_before == pytest.approx(1 / 8, abs=0.02)
