"""Shells that run through each other: boards, rungs, rods."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import shapes
from computed import decompose, decomposer, graph_of
from weak_convex_decomposition.core.geometry.graphs.components import components_at_once
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.solids.crossings import find_crossings
from weak_convex_decomposition.core.steps.progress import run


def bars(*ranges, divisions=4):
    """Return boxes as shells of their own, from ranges along x, y and z."""
    return shapes.joined(
        *(shapes.box(*np.transpose(each), divisions) for each in ranges)
    )


def ladder():
    """Return two rails with five rungs whose ends are within them."""
    rails = [((x - 0.1, x + 0.1), (-0.1, 0.1), (-3, 3)) for x in (-1, 1)]
    heights = np.linspace(-2.4, 2.4, 5)
    rungs = [((-1, 1), (-0.07, 0.07), (z - 0.07, z + 0.07)) for z in heights]
    return bars(*rails, *rungs, divisions=6)


def shelf():
    """Return two sides with five boards; what is between counts as inside."""
    sides = [((x - 0.05, x + 0.05), (-0.5, 0.5), (-2, 2)) for x in (-1.5, 1.5)]
    heights = np.linspace(-1.9, 1.9, 5)
    boards = [((-1.5, 1.5), (-0.5, 0.5), (z - 0.05, z + 0.05)) for z in heights]
    return bars(*sides, *boards, divisions=5)


def temple():
    """Return two slabs, and six columns whose ends are within both."""
    slabs = [((-2.5, 2.5), (-1.5, 1.5), (z - 0.2, z + 0.2)) for z in (-1.2, 1.2)]
    places = [(x, y) for x in (-2, 0, 2) for y in (-1.1, 1.1)]
    columns = [((x - 0.2, x + 0.2), (y - 0.2, y + 0.2), (-1.1, 1.1)) for x, y in places]
    return bars(*slabs, *columns, divisions=6)


def eyes(radius):
    """Return a ball with two small ones that are half within it."""
    ball = shapes.sphere(3)
    small = [
        replace(ball, vertices=radius * ball.vertices + [x, -0.9, 0.3])
        for x in (-0.35, 0.35)
    ]
    return shapes.joined(ball, *small)


def mushroom():
    """Return a stem whose end is within the cap."""
    stem = shapes.turned((0, 0.35, 0.25, 0.28, 0), (0, 0, 0.5, 1.2, 1.2), 24)
    radii, heights = (0, 0.4, 1, 0.9, 0.5, 0), (1, 0.95, 0.85, 1.3, 1.65, 1.75)
    return shapes.joined(stem, shapes.turned(radii, heights, 24))


def pot():
    """Return a ball with a spout, and a low lid through which the ball is seen."""
    lid = shapes.turned((0, 0.5, 0.45, 0), (0.85, 0.87, 1.05, 1.15), 24)
    spout = shapes.box((0.6, -0.15, -0.15), (2.2, 0.15, 0.15), 6)
    return shapes.joined(shapes.sphere(3), lid, spout)


@cache
def found_in(make):
    """Return a function from values of parameters to the decomposition of a mesh."""
    return decomposer(make())


def shells_of(mesh):
    """Return the shell of each face."""
    graph = graph_of(mesh)
    return components_at_once(graph.neighbors, graph.n_polygons)


def assert_same_parts(labels, others):
    assert len(set(zip(labels, others, strict=True))) == len(set(others))
    assert len(set(labels)) == len(set(others))


@pytest.mark.parametrize("seed", [1, 0])  # what is seen with the last serves below
@pytest.mark.parametrize("make", [ladder, shelf, temple])
def test_boards_and_rungs_are_parts(make, seed):
    assert_same_parts(found_in(make)(seed=seed).labels, shells_of(make()))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("make", [mushroom, pot])
def test_where_a_shell_enters_another_no_patch_is_cut_off(make, seed):
    labels, shells = found_in(make)(samples=600, seed=seed).labels, shells_of(make())
    assert len(set(labels)) == 2
    assert len(set(zip(labels, shells, strict=True))) == len(set(shells))


@pytest.mark.parametrize(("radius", "expected"), [(0.1, 1), (0.3, 3)])
def test_small_shells_that_are_stuck_in_join_the_large_one(radius, expected):
    assert decompose(eyes(radius), Parameters(samples=600)).n_parts == expected


def crossings_of(*meshes):
    mesh = shapes.joined(*meshes)
    return run(find_crossings(mesh, shells_of(mesh)[mesh.polygons]))


@pytest.mark.parametrize("divisions", [1, 5])
@pytest.mark.parametrize("foot", [0.8, 1.0])  # within the slab, or on it
def test_shells_cross_along_a_line_around_a_post(divisions, foot):
    slab = shapes.box((0, 0, 0), (3, 3, 1), divisions)
    found = crossings_of(slab, shapes.box((1, 1, foot), (1.5, 2, 2), divisions))
    assert found.lengths.sum() == pytest.approx(3.0, abs=0.01)
    assert found.bends == pytest.approx(np.pi / 2)


def test_shells_apart_do_not_cross():
    one, other = shapes.box(), shapes.box((1.01, 0, 0), (2, 1, 1))
    assert len(crossings_of(one, other).pairs) == 0


def test_lines_are_not_searched_where_shells_lie_on_each_other_everywhere():
    ball = shapes.sphere(3)
    onion = [replace(ball, vertices=scale * ball.vertices) for scale in (1, 0.9999)]
    assert len(crossings_of(*onion).pairs) == 0


@pytest.mark.parametrize(
    ("apart", "width", "end"), [(0.35, 0.3, 2.5), (0.3, 0.25, 2.7)]
)
def test_both_legs_that_end_within_a_body_are_parts_or_none_is(apart, width, end):
    legs = [
        ((x - width, x + width), (-width, width), (0, end)) for x in (-apart, apart)
    ]
    edge = 2 * apart
    mesh = bars(((-edge, edge), (-0.4, 0.4), (1.5, 3.5)), *legs, divisions=6)
    found = decompose(mesh, Parameters(samples=600))
    assert (found.n_parts, len(found.pairs)) == (3, 1)


@pytest.mark.parametrize("seed", range(3))
def test_both_arms_of_a_sofa_are_parts_or_none_is(seed):
    """One was a part, as both are one part more."""
    seat = (-1.2, 1.2), (-0.5, 0.5), (0.1, 0.5)
    back = (-1.2, 1.2), (0.35, 0.55), (0.35, 1.15)
    arms = [(x, (-0.5, 0.5), (0.15, 0.85)) for x in ((-1.27, -1.02), (1.02, 1.27))]
    cushions = [
        (x, (-0.48, 0.38), (0.45, 0.65)) for x in ((-1.03, -0.03), (0.03, 1.03))
    ]
    mesh = bars(seat, back, *arms, *cushions, divisions=1)
    found, shells = decompose(mesh, Parameters(seed=seed)), shells_of(mesh)
    with_seat = set(shells[np.isin(found.labels, found.labels[shells == 0])])
    assert len(with_seat & {2, 3}) in (0, 2)


def test_as_many_parts_as_shells_are_the_shells():
    assert_same_parts(found_in(shelf)(parts=7).labels, shells_of(shelf()))


@pytest.mark.parametrize("make", [ladder, temple])
@pytest.mark.parametrize("parts", [2, 3, 4, 5])
def test_fewer_parts_than_shells_are_one_piece_each(make, parts):
    found, shells = found_in(make)(parts=parts), shells_of(make())
    assert found.n_parts == parts
    for part in range(parts):
        held = set(shells[found.labels == part])
        assert len(held) == 1 or held & {0, 1}  # all others only touch these


@pytest.mark.parametrize("parts", [3, 9])
def test_other_numbers_of_parts_are_found_too(parts):
    assert found_in(ladder)(parts=parts).n_parts == parts


def test_shells_that_have_parts_are_divided():
    rod = shapes.box((1, 1.3, 1.3), (8, 1.7, 1.7), 6)
    mesh = shapes.joined(shapes.dumbbell(), rod)
    found = decompose(mesh, Parameters(samples=600))
    ends = graph_of(mesh).centers[: -rod.n_polygons, 0]
    labels = found.labels[: -rod.n_polygons]
    assert set(labels[ends < 2.9]).isdisjoint(labels[ends > 6.1])


def test_more_shells_than_most_parts_are_no_parts():
    assert found_in(ladder)(max_parts=5).n_parts <= 5
