from dataclasses import replace

import changes
import numpy as np
import pytest
import shapes
from computed import cut_seams_of, search_part_count, see
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.part_psi import count_parts
from weak_convex_decomposition.core.parts.partition import Partitioner
from weak_convex_decomposition.core.parts.seams.cutter import SeamCutter
from weak_convex_decomposition.core.steps.progress import run


def two_ls():
    return shapes.joined(
        shapes.l_shape(), changes.moved(shapes.l_shape(), offset=(20, 0, 0))
    )


SHAPES = [shapes.l_shape, shapes.dumbbell, shapes.comb, two_ls]
PARAMETERS = Parameters(samples=150)


def by_name(make):
    return make.__name__


@pytest.mark.parametrize("n_parts", range(1, 9))
@pytest.mark.parametrize("make", SHAPES, ids=by_name)
def test_exactly_as_many_parts_as_asked_for(seen, make, n_parts):
    partitioner = Partitioner(seen(make), PARAMETERS)
    parts = partitioner.partition(n_parts)
    assert set(parts) == set(range(n_parts))
    cut = cut_seams_of(partitioner, parts)
    assert set(cut) == set(range(n_parts))


@pytest.mark.parametrize("make", SHAPES, ids=by_name)
@pytest.mark.parametrize("n_parts", [2, 5])
def test_parts_are_connected_and_not_too_small(seen, make, n_parts):
    partitioner = Partitioner(seen(make), PARAMETERS)
    parts = cut_seams_of(partitioner, partitioner.partition(n_parts))
    surface = partitioner.graph
    assert surface.areas_of(parts).min() >= partitioner.smallest_area
    assert count_parts(surface.pieces(parts, 0.0)) == n_parts


def test_more_parts_than_polygons_are_as_many_as_can_be(seen):
    partitioner = Partitioner(seen(shapes.l_prism), PARAMETERS)
    parts = partitioner.partition(40)
    assert 2 <= count_parts(parts) <= 8
    assert set(parts) == set(range(count_parts(parts)))


def test_the_same_partition_every_time(seen):
    visibility = seen(shapes.comb)
    first, second = (Partitioner(visibility, PARAMETERS).partition(5) for _ in range(2))
    assert (first == second).all()


def test_no_seams_are_cut_without_smoothness(seen):
    partitioner = Partitioner(
        seen(shapes.comb), replace(PARAMETERS, smoothness=0.0, smallest_part=0.0)
    )
    parts = partitioner.partition(5)
    assert (cut_seams_of(partitioner, parts) == parts).all()


def test_heavy_seams_swallow_no_part(seen):
    partitioner = Partitioner(seen(shapes.comb), replace(PARAMETERS, smoothness=100.0))
    parts = partitioner.partition(5)
    assert count_parts(cut_seams_of(partitioner, parts)) == 5


def test_seams_are_short_beside_parts_that_they_would_swallow(seen):
    partitioner = Partitioner(seen(shapes.comb), replace(PARAMETERS, smoothness=30.0))
    parts = partitioner.partition(9)
    cut = cut_seams_of(partitioner, parts)
    assert count_parts(cut) == 9
    before, after = (
        partitioner.graph.borders(labels, 9).sum() for labels in (parts, cut)
    )
    assert after < before


@pytest.mark.parametrize("n_parts", [5, 9])
def test_parts_that_seams_would_swallow_do_not_soften_other_seams(seen, n_parts):
    partitioner = Partitioner(seen(shapes.comb), replace(PARAMETERS, smoothness=30.0))
    parts = partitioner.partition(n_parts)
    seams = run(SeamCutter(partitioner).cut(parts, -np.inf))
    assert seams.smoothness == 30.0
    assert count_parts(seams.parts) == n_parts


def test_parts_that_seams_would_swallow_get_short_ones_at_the_end(seen):
    partitioner = Partitioner(seen(shapes.comb), replace(PARAMETERS, smoothness=30.0))
    cutter = SeamCutter(partitioner)
    cut = run(cutter.cut(partitioner.partition(9), -np.inf))
    assert cut.ragged.any()
    smooth = run(cutter.smoothed(cut))
    assert smooth.ragged is None
    assert count_parts(smooth.parts) == 9
    borders = partitioner.graph.borders
    assert borders(smooth.parts, 9).sum() < borders(cut.parts, 9).sum()
    moved = smooth.parts != cut.parts
    beside = cut.ragged[partitioner.graph.neighbors].any(axis=1)
    near = np.unique(partitioner.graph.neighbors[beside])
    assert np.isin(np.flatnonzero(moved), near).mean() > 0.5
    assert run(cutter.smoothed(cut)) is smooth


def test_seams_get_short_at_the_end_if_all_cuts_cost_too_much_psi(seen):
    partitioner = Partitioner(seen(two_ls), PARAMETERS)
    cutter, parts = SeamCutter(partitioner), partitioner.partition(5)
    cut = run(cutter.cut(parts, np.inf))
    assert (cut.parts == parts).all()
    smooth = run(cutter.smoothed(cut))
    assert count_parts(smooth.parts) == 5
    borders = partitioner.graph.borders
    assert borders(smooth.parts, 5).sum() < borders(parts, 5).sum()
    assert (smooth.parts == parts).mean() > 0.8


def test_short_seams_tear_no_part_in_two():
    """Of two bars that cross, one is whole on a strip of the other one's back."""
    bars = ((0, 24), (9, 15), (0, 6)), ((9, 15), (0, 24), (0, 6))
    mesh = shapes.blocks((24, 24, 6), *bars)
    partitioner = Partitioner(see(mesh, PARAMETERS), PARAMETERS)
    x, y, z = partitioner.graph.centers.T * mesh.diagonal  # in cells, from the middle
    strip = (np.abs(y) < 1) & (z < -2.9)
    parts = np.where((np.abs(x) < 3.1) & ~strip, 0, 1)
    cutter = SeamCutter(partitioner)
    smooth = run(cutter.smoothed(run(cutter.cut(parts, np.inf))))
    along_y, along_x = (set(smooth.parts[np.abs(arm) > 4]) for arm in (y, x))
    assert len(along_y) == len(along_x) == 1
    assert along_y.isdisjoint(along_x)


@pytest.mark.parametrize("make", SHAPES, ids=by_name)
@pytest.mark.parametrize("n_parts", [2, 3, 5])
def test_seams_cost_no_more_than_moves_gained_or_sampling_errs(seen, make, n_parts):
    memo = seen(make)
    heavy = replace(PARAMETERS, smoothness=20.0)
    partitioner = Partitioner(memo, heavy)
    parts = partitioner.partition(n_parts)
    plain = Partitioner(seen(make), replace(heavy, refinement="EMBEDDING"))
    enough = min(
        partitioner.psi(parts) - partitioner.sampling_error,
        plain.psi(plain.partition(n_parts)),
    )
    assert partitioner.psi(cut_seams_of(partitioner, parts)) >= enough


def test_seams_get_short_where_moves_gained_nothing(seen):
    """A third of a seam for 0.002 of psi."""
    partitioner = Partitioner(seen(shapes.dumbbell), PARAMETERS)
    parts = partitioner.plain(2)
    cut, borders = cut_seams_of(partitioner, parts), partitioner.graph.borders
    assert partitioner.psi(cut) < partitioner.psi(parts)
    assert borders(cut, 2).sum() < 0.7 * borders(parts, 2).sum()


def test_a_large_smallest_part_leaves_few(seen):
    partitioner = Partitioner(seen(shapes.comb), replace(PARAMETERS, smallest_part=0.3))
    parts = partitioner.partition(8)
    assert count_parts(parts) <= 3
    areas = partitioner.graph.areas_of(parts)
    assert areas.min() >= 0.3 * areas.sum()


def test_psi_is_that_of_the_labels_of_the_samples(seen):
    memo = seen(shapes.comb)
    visibility = memo.visibility
    partitioner = Partitioner(memo, replace(PARAMETERS, alpha=2.0))
    parts = partitioner.partition(3)
    labels = parts[visibility.nodes]
    same = labels[:, None] == labels
    los = visibility.psi_pairs.visible > 0
    expected = (los[same].sum() + 2.0 * (~los[~same]).sum()) / los.size
    assert partitioner.psi(parts) == pytest.approx(expected)


# The search for k.


@pytest.mark.parametrize("make", SHAPES, ids=by_name)
def test_the_search_returns_the_parts_of_largest_psi(seen, make):
    found, partitioner = search_part_count(seen(make), PARAMETERS, 2, 6)
    parts, psi_by_k = found.seams.parts, found.psi_by_k
    assert list(psi_by_k) == [1, 2, 3, 4, 5, 6]
    # Fewer parts may be preferred where psi hardly differs.
    best = max(psi_by_k.values())
    assert psi_by_k[count_parts(parts)] == pytest.approx(best, abs=0.01)
    # Cutting seams costs a little.
    assert partitioner.psi(parts) == pytest.approx(
        psi_by_k[count_parts(parts)], abs=0.01
    )


def shaft():
    """Return a shaft along x through a disc: its ends see each other through it."""
    return shapes.blocks((9, 6, 6), ((0, 9), (2, 4), (2, 4)), ((4, 5), (0, 6), (0, 6)))


def test_a_shaft_through_a_disc_has_three_parts(seen):
    found, _ = search_part_count(seen(shaft), PARAMETERS, 2, 6)
    assert count_parts(found.seams.parts) == 3


def test_the_search_keeps_to_its_range(seen):
    found, _ = search_part_count(seen(shapes.comb), PARAMETERS, 2, 3)
    parts, psi_by_k = found.seams.parts, found.psi_by_k
    assert set(psi_by_k) == {1, 2, 3}
    assert count_parts(parts) == 3
    found, _ = search_part_count(seen(shapes.comb), PARAMETERS, 7, 7)
    parts, psi_by_k = found.seams.parts, found.psi_by_k
    assert set(psi_by_k) == {1, 7}
    assert count_parts(parts) == 7


def test_the_search_ends_where_the_shape_has_no_more_parts(seen):
    found, _ = search_part_count(seen(shapes.l_prism), PARAMETERS, 2, 256)
    parts, psi_by_k = found.seams.parts, found.psi_by_k
    assert max(psi_by_k) <= 8
    assert count_parts(parts) == 2


def test_one_part_stays_when_no_more_gain_anything(seen):
    found, _ = search_part_count(seen(shapes.box), PARAMETERS, 2, 5)
    parts, psi_by_k = found.seams.parts, found.psi_by_k
    assert count_parts(parts) == 1
    assert psi_by_k[1] == 1.0
