import numpy as np
import pytest
import shapes
from computed import graph_of
from weak_convex_decomposition.core.parts.merging.pieces import (
    connected_parts,
    merge_to,
)
from weak_convex_decomposition.core.sight.pair_visibility import PairVisibility

BOX = graph_of(shapes.box(divisions=4))
LEFT = BOX.centers[:, 0] < 0.5


def assert_numbered(parts):
    assert set(parts) == set(range(parts.max() + 1))


def test_large_connected_parts_are_kept():
    parts = connected_parts(BOX, LEFT.astype(int), 0.1)
    assert_numbered(parts)
    assert ((parts == parts[LEFT.argmax()]) == LEFT).all()


def test_specks_join_the_neighbor_around_them():
    labels = LEFT.astype(int)
    speck = np.linalg.norm(BOX.centers - [0.125, 0.125, 1], axis=1).argmin()
    assert LEFT[speck]
    labels[speck] = 0
    parts = connected_parts(BOX, labels, 0.1)
    assert parts.max() == 1
    assert parts[speck] == parts[LEFT].max() == parts[LEFT].min()


def test_specks_in_specks_join_what_is_left():
    labels = np.arange(BOX.n_polygons)
    labels[LEFT] = labels[LEFT][0]
    parts = connected_parts(BOX, labels, 0.1)
    assert_numbered(parts)
    assert BOX.areas_of(parts).min() >= 0.1
    assert len(set(parts[LEFT])) == 1


def test_nothing_is_too_small_for_a_limit_of_zero():
    labels = np.arange(BOX.n_polygons)
    assert connected_parts(BOX, labels, 0.0).max() == BOX.n_polygons - 1


def test_everything_is_one_part_where_all_is_too_small():
    parts = connected_parts(BOX, np.arange(BOX.n_polygons), 100.0)
    assert (parts == 0).all()


def test_large_pieces_of_one_label_become_parts():
    ends = (np.abs(BOX.centers[:, 0] - 0.5) > 0.3).astype(int)
    assert connected_parts(BOX, ends, 0.1).max() == 2


def test_a_small_shell_of_its_own_joins_the_nearest_part():
    mesh = shapes.joined(
        shapes.box(),
        shapes.box((4, 0, 0), (5, 1, 1)),
        shapes.box((3.7, 0.4, 0.4), (3.8, 0.5, 0.5)),
    )
    parts = connected_parts(graph_of(mesh), np.zeros(18, dtype=int), 0.5)
    assert_numbered(parts)
    assert parts.max() == 1
    assert (parts[12:] == parts[6]).all()
    assert parts[0] != parts[6]


@pytest.fixture
def tally():
    """Return pairs of samples of four parts, of which 0 and 2 see each other."""
    labels = np.repeat(np.arange(4), 10)
    los = labels[:, None] == labels
    los |= (labels[:, None] % 2 == 0) & (labels % 2 == 0)
    return PairVisibility(los.astype(np.float32), None).tally(labels, 4)


ALL = ~np.eye(4, dtype=bool)


def test_the_pair_that_gains_most_is_merged_first(tally):
    merged = merge_to(3, tally, ALL, 1.0)
    assert_numbered(merged)
    assert merged.max() == 2
    assert merged[0] == merged[2]


@pytest.mark.parametrize("n_parts", [1, 2, 3, 4, 9])
def test_as_many_are_left_as_asked_for(tally, n_parts):
    merged = merge_to(n_parts, tally, ALL, 1.0)
    assert_numbered(merged)
    assert merged.max() + 1 == min(n_parts, 4)


def test_parts_that_touch_are_merged_before_others(tally):
    touching = np.zeros((4, 4), dtype=bool)
    touching[0, 1] = touching[1, 0] = True
    merged = merge_to(3, tally, touching, 1.0)
    assert merged[0] == merged[1]
    merged = merge_to(2, tally, touching, 1.0)
    assert merged[0] == merged[1]
    assert merged[2] == merged[0]


def test_a_merged_part_touches_what_its_halves_touched(tally):
    touching = np.zeros((4, 4), dtype=bool)
    for one, other in ((0, 2), (2, 3)):
        touching[one, other] = touching[other, one] = True
    merged = merge_to(2, tally, touching, 1.0)
    assert merged.tolist() == [0, 1, 0, 0]
    assert touching.sum() == 4


def test_scattered_specks_of_a_label_stay_together():
    boxes = [shapes.box((9 * i, 0, 0), (9 * i + 1, 1, 1)) for i in range(8)]
    surface = graph_of(shapes.joined(*boxes))
    labels = np.repeat([0, 1], 24)
    parts = connected_parts(surface, labels, smallest_area=7.0)
    assert parts.tolist() == labels.tolist()
