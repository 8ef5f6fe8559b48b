"""Shells that run through each other: boards, rungs, rods."""

from functools import cache

import numpy as np
import pytest
import shapes
from computed import decompose, decomposer, graph_of
from weak_convex_decomposition.core.geometry.graphs.components import components_at_once
from weak_convex_decomposition.core.parameters.parts import Parameters


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
@pytest.mark.parametrize("make", [ladder, shelf])
def test_boards_and_rungs_are_parts(make, seed):
    assert_same_parts(found_in(make)(seed=seed).labels, shells_of(make()))


def test_as_many_parts_as_shells_are_the_shells():
    assert_same_parts(found_in(shelf)(parts=7).labels, shells_of(shelf()))


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
