import dataclasses

import changes
import numpy as np
import pytest
import shapes
from brute_caster import WatchedCaster, are_cast
from computed import decompose, measure, parts_of, see
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run

CONVEX = {
    "box": lambda: shapes.box(divisions=3),
    "slab": lambda: shapes.box(high=(3, 2, 0.1)),
    "ball": lambda: shapes.sphere(2),
    "cone": lambda: shapes.turned([0, 1, 0], [0, 0, 2], 16),
}


def refuse(mesh):
    """Stand for a ray caster that must not be made."""
    raise AssertionError("Rays are cast.")


@pytest.mark.parametrize("name", CONVEX)
def test_the_search_finds_what_is_known_without_it(name):
    mesh, parameters = CONVEX[name](), Parameters(samples=150, max_parts=4)
    known = decompose(mesh, parameters, make_caster=refuse)
    found = parts_of(see(mesh, parameters), parameters)
    assert len(found.psi_by_k) > 1
    assert (known.n_parts, known.best_k) == (found.n_parts, found.best_k) == (1, 1)
    assert (known.labels == found.labels).all()
    assert known.areas == pytest.approx(found.areas)
    assert (known.face_counts == found.face_counts).all()
    assert (known.psi, known.psi_before, known.ranks.tolist()) == (1, 1, [1])
    assert found.psi == pytest.approx(1, abs=0.01)
    assert known.psi_by_k == {1: 1.0}
    for field in dataclasses.fields(known):
        one, other = getattr(known, field.name), getattr(found, field.name)
        assert getattr(one, "dtype", None) == getattr(other, "dtype", None), field.name


def test_notes_on_the_shape_stay():
    (note,) = decompose(changes.inside_out(shapes.box()), Parameters()).notes
    assert "inside out" in note


@pytest.mark.parametrize(
    "asked", [{"parts": 2}, {"parts": 5}, {"levels": 2}, {"min_parts": 3}], ids=str
)
def test_what_asks_for_more_is_searched_for(asked):
    mesh, parameters = shapes.box(divisions=3), Parameters(samples=60, **asked)
    with pytest.raises(AssertionError, match="Rays are cast"):
        decompose(mesh, parameters, make_caster=refuse)
    found = decompose(mesh, parameters)
    assert found.n_parts == max(1, parameters.parts)


def test_some_faces_of_a_convex_shape_are_decomposed_by_lines_of_sight():
    mesh = shapes.box(divisions=3)
    members = np.arange(mesh.n_polygons) < 20
    with pytest.raises(AssertionError, match="Rays are cast"):
        decompose(mesh, Parameters(samples=60), members, refuse)
    assert len(decompose(mesh, Parameters(samples=60), members).labels) == 20


def test_the_cache_needs_no_lines_of_sight_for_it():
    cache, mesh, one = ShapeCache(WatchedCaster), shapes.box(), Parameters(samples=60)

    def sees(parameters):
        return are_cast(lambda: run(decompose_in_steps(mesh, parameters, cache)))

    assert not sees(one)
    two = Parameters(samples=60, parts=2)
    assert sees(two)
    assert not sees(two)
    assert run(decompose_in_steps(mesh, two, cache)).n_parts == 2
    assert not sees(one)


def test_measured_by_rays_it_is_convex_as_well():
    assert measure(shapes.sphere(2), Parameters(samples=150)).rank > 0.99
