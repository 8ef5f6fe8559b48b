"""Lines of sight in blocks, beside those of all pairs."""

from functools import cache, partial

import large_shapes
import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from computed import lines_of_sight, prepare
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.sight.visibility import find_lines_of_sight
from weak_convex_decomposition.core.steps.progress import run

N_SAMPLES = 300


def building():
    return large_shapes.building(8, 1, 8)


def sight(mesh, **values):
    return lines_of_sight(mesh, Parameters(**{"samples": N_SAMPLES, **values}))


@cache
def see(make, **values):
    """Return which samples of a mesh see each other."""
    return sight(make(), **values).rank_pairs


def wrong(make, **values):
    """Return the share of entries in which blocks differ from all pairs."""
    exact = see(make, sight="ALL_PAIRS")
    return (see(make, **values).visible != exact.visible).mean()


def rays_cast(mesh, **values):
    """Return the rays that are cast between samples, and those cast before."""
    shape = prepare(mesh, BruteCaster)
    steps = find_lines_of_sight(shape, Parameters(samples=N_SAMPLES, **values))
    while next(steps).fraction < 0.02:
        pass  # viewpoints are looked for
    before = shape.marcher.n_cast
    run(steps)
    return shape.marcher.n_cast - before, before


@pytest.mark.parametrize("make", [shapes.l_prism, shapes.cup, building])
def test_few_entries_differ_from_all_pairs(make):
    pairs, exact = see(make), see(make, sight="ALL_PAIRS")
    assert wrong(make) < 0.01
    assert (pairs.visible == pairs.visible.T).all()
    assert (pairs.visible.diagonal() == 1).all()
    assert pairs.known is None
    assert pairs.n_cast + pairs.n_inferred == exact.n_cast
    assert pairs.n_cast < 0.5 * exact.n_cast


def test_a_convex_shape_needs_few_rays():
    pairs = see(shapes.uv_sphere)
    assert (pairs.visible == 1).all()
    assert pairs.n_cast < 0.4 * pairs.n_inferred


def test_pairs_that_do_not_face_each_other_are_hidden():
    exact, pairs = (see(shapes.l_prism, **kw) for kw in ({"sight": "ALL_PAIRS"}, {}))
    n_pairs = N_SAMPLES * (N_SAMPLES - 1) // 2
    assert exact.n_cast < n_pairs
    assert pairs.visible.sum() <= 2 * exact.n_cast + N_SAMPLES


def test_the_seed_alone_decides():
    once, again = (sight(shapes.cup(), seed=3).rank_pairs.visible for _ in range(2))
    assert (once == again).all()
    assert (once != sight(shapes.cup(), seed=4).rank_pairs.visible).any()


def test_scale_and_place_do_not_matter():
    mesh = shapes.cup()
    moved = shapes.mesh_of(7e3 + 1e3 * mesh.vertices, mesh.triangles)
    assert (sight(moved).rank_pairs.visible != see(shapes.cup).visible).mean() < 0.01


@pytest.mark.parametrize("make", [shapes.l_prism, building])
@pytest.mark.parametrize("n_rays", [1, 8, 40])
@pytest.mark.parametrize("kind", ["BLOCKS", "ALL_PAIRS"])
def test_no_more_rays_are_cast_than_asked_for(make, n_rays, kind):
    between_samples, _ = rays_cast(make(), rays=n_rays, sight=kind)
    # The last lines may pass more surfaces than the others did.
    assert between_samples <= 1.05 * n_rays * N_SAMPLES + 20
    assert between_samples >= 0.2 * n_rays * N_SAMPLES


@pytest.mark.parametrize("make", [shapes.l_prism, shapes.cup, building])
def test_more_rays_find_more(make):
    shares = [wrong(make, rays=n_rays) for n_rays in (2, 8, 0)]
    assert shares == sorted(shares, reverse=True)
    assert shares[0] > 5 * shares[-1]


def test_enough_rays_are_as_good_as_any():
    assert (see(shapes.cup, rays=1000).visible == see(shapes.cup).visible).all()
    all_pairs = see(shapes.cup, sight="ALL_PAIRS")
    assert (
        see(shapes.cup, sight="ALL_PAIRS", rays=1000).visible == all_pairs.visible
    ).all()


def test_few_rays_between_all_pairs_leave_pairs_unknown():
    some = see(shapes.cup, sight="ALL_PAIRS", rays=20)
    exact = see(shapes.cup, sight="ALL_PAIRS").visible
    known = some.known.toarray() > 0
    np.fill_diagonal(known, False)
    assert 0 < known.mean() < 0.3
    assert ((some.visible.toarray() > 0) == (exact > 0))[known].all()
    assert some.n_inferred == 0


@pytest.mark.parametrize(
    "make",
    [
        lambda: large_shapes.building(40, 1, 8),
        lambda: large_shapes.nested_spheres(20, 0),
        lambda: large_shapes.copies(shapes.sphere(0), 30),
        lambda: large_shapes.slabs(8),
        lambda: large_shapes.loose_pieces(60),
    ],
    ids=["building", "nested", "copies", "slabs", "loose"],
)
def test_many_shells_cost_a_bounded_number_of_rays(make):
    between_samples, before = rays_cast(make())
    assert between_samples <= 1.05 * 200 * N_SAMPLES
    # Seven rays a sample find viewpoints; each passes all shells on its way.
    assert before <= 7 * 65 * N_SAMPLES


def test_pairs_of_far_pieces_are_answered_too():
    pieces = partial(large_shapes.loose_pieces, 9)
    assert wrong(pieces, rays=2) < 0.1  # most blocks have no pair that was cast
    assert wrong(pieces) < 0.01


@pytest.mark.parametrize("n_samples", [16, 28])
def test_few_samples_are_all_looked_at(n_samples):
    pairs, exact = (
        see(shapes.l_prism, samples=n_samples, sight=kind)
        for kind in ("BLOCKS", "ALL_PAIRS")
    )
    assert (pairs.visible == exact.visible).all()
    assert pairs.n_inferred <= 0.2 * exact.n_cast


def test_blocks_report_their_progress():
    shape = prepare(shapes.l_prism())
    steps = find_lines_of_sight(shape, Parameters(samples=600))
    fractions = [progress.fraction for progress in steps]
    assert len(fractions) > 10
    assert fractions == sorted(fractions)
    assert fractions[-1] <= 1
