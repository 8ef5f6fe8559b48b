"""What is kept for another cut, and what tells whether it is still right."""

from dataclasses import fields, replace
from itertools import combinations

import numpy as np
import pytest
import shapes
from brute_caster import WatchedCaster, are_cast
from clouds import cloud_of
from computed import decompose
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.geometry.point_cloud import PointCloud
from weak_convex_decomposition.core.geometry.shape import are_equal, digest_of
from weak_convex_decomposition.core.parameters.parameter import info_of
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run

BEFORE = Parameters(samples=120, max_parts=5)
# A value of each parameter that changes what comes out.
CHANGES = {
    "parts": 9,
    "rays": 31,
    "alpha": 1.0,
    "sight": "CONE",
    "sampling": "FACES",
    "samples": 121,
    "cone_angle": 1.0,
    "psi_pairs": "RAYS",
    "containers": "HOLLOW",
    "normalization": "STOCHASTIC",
    "min_parts": 4,
    "max_parts": 8,
    "refinement": "EMBEDDING",
    "smoothness": 0.0,
    "seams": "CUT",
    "bends": "KEEP",
    "smallest_part": 0.1,
    "levels": 2,
    "seed": 1,
}
OF_THE_CUT = [f.name for f in fields(Parameters) if not info_of(f).affects_sight]


def sees_anew(cache, mesh, parameters=BEFORE):
    """Return whether decomposing a mesh casts rays."""
    return are_cast(lambda: run(decompose_in_steps(mesh, parameters, cache)))


def result(found):
    numbers = sorted(found.psi_by_k.items())
    return found.labels.tolist(), found.psi, numbers, found.ranks.tolist()


@pytest.fixture(scope="module")
def cache():
    """A cache that has decomposed a comb."""
    cache = ShapeCache(WatchedCaster)
    run(decompose_in_steps(shapes.comb(), BEFORE, cache))
    return cache


@pytest.mark.parametrize("name", OF_THE_CUT)
def test_a_new_cut_is_that_of_a_new_run(cache, decomposed, name):
    after = replace(BEFORE, **{name: CHANGES[name]})
    again = run(decompose_in_steps(shapes.comb(), after, cache))
    assert result(again) == result(decompose(shapes.comb(), after))
    back = run(decompose_in_steps(shapes.comb(), BEFORE, cache))
    assert result(back) == result(decomposed(shapes.comb, samples=120, max_parts=5))


def test_lines_of_sight_are_kept_for_what_does_not_affect_them(cache):
    for name in CHANGES.keys() - {"levels", "bends"}:  # these look at the shape
        after = replace(BEFORE, **{name: CHANGES[name]})
        run(decompose_in_steps(shapes.comb(), BEFORE, cache))
        assert sees_anew(cache, shapes.comb(), after) == (name not in OF_THE_CUT), name


def test_thickness_is_looked_at_once(cache):
    bent = replace(BEFORE, bends="KEEP")
    run(decompose_in_steps(shapes.comb(), bent, cache))
    assert not sees_anew(cache, shapes.comb(), replace(bent, parts=3))


def test_rays_are_cast_once_for_a_shape_and_its_parts(monkeypatch):
    made = []

    def caster(mesh):
        made.append(mesh)
        return WatchedCaster(mesh)

    cache, mesh = ShapeCache(caster), shapes.comb()
    found = run(decompose_in_steps(mesh, BEFORE, cache))
    run(decompose_in_steps(mesh, replace(BEFORE, levels=2), cache))
    run(decompose_in_steps(mesh, BEFORE, cache, found.labels == 0))
    assert len(made) == 1
    # That of a part did not take its place.
    assert not sees_anew(cache, mesh)


def test_what_few_samples_see_of_a_part_is_kept():
    cache = ShapeCache(WatchedCaster)
    prepared = run(cache.prepare(shapes.comb()))
    members = prepared.nodes < prepared.n_nodes // 2

    def see(chosen):
        return run(cache.see(prepared.part(chosen), BEFORE))

    kept = see(members)
    assert see(members) is kept
    assert see(~members) is not kept
    run(cache.prepare(shapes.l_shape()))
    run(cache.prepare(shapes.comb()))
    assert see(members) is not kept


def test_parts_of_clouds_with_other_points_of_the_same_splats_are_others():
    cloud = cloud_of(shapes.box(), 400)
    copied = replace(
        cloud,
        points=np.concatenate([cloud.points, cloud.points[:100]]),
        normals=np.concatenate([cloud.normals, cloud.normals[:100]]),
    )
    cache = ShapeCache(WatchedCaster)
    some = np.arange(len(copied.points)) < 150
    more = some | (np.arange(len(copied.points)) >= 400)
    for members in (some, more):
        found = run(decompose_in_steps(copied, BEFORE, cache, members))
        assert len(found.labels) == members.sum()


def test_every_parameter_is_tried():
    assert list(CHANGES) == [field.name for field in fields(Parameters)]


@pytest.mark.parametrize("name", ["vertices", "triangles", "polygons"])
def test_a_changed_mesh_is_another_one(cache, name):
    mesh = shapes.comb()
    array = getattr(mesh, name).copy()
    array[[0, -1]] = array[[-1, 0]]
    changed = replace(mesh, **{name: array})
    run(decompose_in_steps(mesh, BEFORE, cache))
    assert not sees_anew(cache, mesh)
    assert sees_anew(cache, changed)


def test_clouds_with_other_normals_are_others():
    points = shapes.comb().vertices
    clouds = [
        PointCloud(points, normals)
        for normals in (None, np.ones_like(points), -np.ones_like(points))
    ]
    for one, other in combinations(clouds, 2):
        assert not are_equal(one, other)
        assert digest_of(one) != digest_of(other)
    for each in clouds:
        assert are_equal(each, replace(each))
        assert digest_of(each) == digest_of(replace(each))


def test_results_of_equal_shapes_are_kept_where_that_is_asked_for():
    cache = ShapeCache(WatchedCaster, n_results=2)
    first = run(decompose_in_steps(shapes.comb(), BEFORE, cache))
    run(decompose_in_steps(shapes.l_shape(), BEFORE, cache))
    again = run(decompose_in_steps(shapes.comb(), BEFORE, cache))
    assert again.labels is first.labels
    assert not sees_anew(cache, shapes.comb())
    assert sees_anew(cache, shapes.comb(), replace(BEFORE, seed=1))
    run(decompose_in_steps(shapes.plus(), BEFORE, cache))
    assert sees_anew(cache, shapes.comb())  # it was the third latest
    chosen = np.arange(shapes.comb().n_polygons) % 2 == 0
    some = run(decompose_in_steps(shapes.comb(), BEFORE, cache, chosen))
    others = run(decompose_in_steps(shapes.comb(), BEFORE, cache, ~chosen))
    assert some is not others
    cache.forget()
    assert sees_anew(cache, shapes.comb())


def test_results_of_large_shapes_are_not_kept(monkeypatch):
    monkeypatch.setattr("weak_convex_decomposition.core.cache._SMALL", 100)
    cache = ShapeCache(WatchedCaster, n_results=2)
    run(decompose_in_steps(shapes.comb(), BEFORE, cache))
    run(decompose_in_steps(shapes.l_shape(), BEFORE, cache))
    assert sees_anew(cache, shapes.comb())


def test_what_was_seen_of_a_shape_while_another_came_is_not_taken_for_that():
    cache = ShapeCache(WatchedCaster)
    steps = cache.see(run(cache.prepare(shapes.comb())), BEFORE)
    next(steps)
    other = run(cache.prepare(shapes.box()))
    run(steps)
    assert run(cache.see(other, BEFORE)).visibility.shape is other


def test_forgotten_is_forgotten():
    cache, mesh = ShapeCache(WatchedCaster), shapes.l_shape()
    run(decompose_in_steps(mesh, BEFORE, cache))
    assert not sees_anew(cache, mesh)
    cache.forget()
    assert sees_anew(cache, mesh)


def test_what_a_user_does_to_a_result_stays_out_of_the_next_one():
    cache = ShapeCache(WatchedCaster, n_results=2)
    for parts in (0, 3):
        parameters = replace(BEFORE, parts=parts)
        found, again = (
            run(decompose_in_steps(shapes.comb(), parameters, cache)) for _ in range(2)
        )
        before = result(again)
        found.psi_by_k.clear()
        with pytest.raises(ValueError, match="read-only"):
            found.labels[0] = 1
        later = run(decompose_in_steps(shapes.comb(), parameters, cache))
        assert result(later) == before


@pytest.mark.parametrize("caster", [None, "EMBREE"])
def test_what_makes_no_casters_is_refused_at_once(caster):
    with pytest.raises(TypeError, match="`make_caster` must be a class"):
        ShapeCache(caster)
