"""New parts matched with former ones by the area that they share."""

from itertools import permutations

import numpy as np
import pytest
from weak_convex_decomposition.core.parts.matching import given_back, match_parts


def kept(before, after, areas, former):
    """Return the area that keeps its part."""
    return areas[before == former[after]].sum()


def test_parts_with_other_numbers_are_recognized():
    before = np.array([0, 0, 1, 1, 2, 2])
    after = np.array([2, 2, 0, 0, 1, 1])
    assert match_parts(before, after, np.ones(6)).tolist() == [1, 2, 0]


def test_the_larger_piece_of_a_split_part_continues_it():
    before = np.array([0, 0, 0, 0, 1])
    after = np.array([0, 1, 1, 1, 2])
    areas = np.array([5.0, 1, 1, 1, 1])
    assert match_parts(before, after, areas).tolist() == [0, -1, 1]
    assert match_parts(before, after, np.ones(5)).tolist() == [-1, 0, 1]


def test_a_part_that_shares_nothing_is_new():
    assert match_parts(np.zeros(4, int), np.array([0, 0, 0, 1]), np.ones(4))[1] == -1


@pytest.mark.parametrize("seed", range(20))
def test_no_other_matching_keeps_more_area(seed):
    rng = np.random.default_rng(seed)
    n_before, n_after = rng.integers(1, 4, 2)
    before, after = rng.integers(n_before, size=60), rng.integers(n_after, size=60)
    _, after = np.unique(after, return_inverse=True)
    areas = rng.uniform(0.1, 1, 60)
    former = match_parts(before, after, areas)
    matched = former[former >= 0]
    assert len(set(matched.tolist())) == len(matched)
    n_after = len(former)
    most = max(
        kept(before, after, areas, np.array(order))
        for order in permutations([*range(before.max() + 1), *[-1] * n_after], n_after)
    )
    assert kept(before, after, areas, former) == pytest.approx(most)


def test_settled_polygons_go_back_to_the_part_that_continues_theirs():
    before = np.array([0, 0, 0, 1, 1, 1])
    after = np.array([1, 1, 1, 1, 0, 0])
    by_hand = np.array([False] * 3 + [True] + [False] * 2)
    labels = given_back(before, after, np.ones(6), by_hand)
    assert labels.tolist() == [1, 1, 1, 0, 0, 0]


def test_settled_polygons_whose_part_is_gone_stay_a_part():
    before = np.array([0, 0, 0, 1, 1])
    after = np.zeros(5, int)
    by_hand = np.array([False, False, False, True, False])
    labels = given_back(before, after, np.ones(5), by_hand)
    assert labels.tolist() == [0, 0, 0, 1, 0]


def test_if_all_is_settled_nothing_changes():
    before, after = np.array([0, 1, 1, 2]), np.zeros(4, int)
    labels = given_back(before, after, np.ones(4), np.ones(4, bool))
    assert labels.tolist() == [0, 1, 1, 2]


def test_a_part_without_area_of_the_one_that_is_left_is_new():
    before, after = np.array([0, 0, 1, 2]), np.array([0, 1, 2, 2])
    areas = np.array([2.0, 1.0, 2.0, 1.0])
    assert match_parts(before, after, areas).tolist() == [0, -1, 1]
