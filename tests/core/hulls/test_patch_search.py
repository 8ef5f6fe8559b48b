"""The search of patches for the largest value of a function that is known."""

import numpy as np
import pytest
from weak_convex_decomposition.core.hulls.measure import patch_search
from weak_convex_decomposition.core.hulls.measure.fragments import reach_of
from weak_convex_decomposition.core.hulls.measure.patch_search import PatchSearch

PEAK = np.array([0.3, 0.4, 0.0])
SQUARE = np.array(
    [[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]]
)


class Hill:
    """A height of 1 at the peak, which falls off as the distance; counts patches."""

    def __init__(self):
        self.looked_at = 0

    def __call__(self, corners, _):
        self.looked_at += len(corners)
        centers, radii = reach_of(corners)
        heights = 1 - np.linalg.norm(centers - PEAK, axis=1)
        return heights, heights + radii


def searched():
    return PatchSearch(SQUARE.astype(np.float64))


@pytest.mark.parametrize("tolerance", [0.01, 0.1])
def test_the_bound_is_above_the_largest_value_by_the_tolerance_at_most(tolerance):
    search = searched()
    bound = search.largest(Hill(), 0.1, np.inf, tolerance)
    assert 1 <= bound <= 1 + tolerance
    assert np.linalg.norm(search.place - PEAK) < 3 * tolerance


def test_values_below_enough_are_not_told_apart():
    search, hill = searched(), Hill()
    assert search.largest(hill, 2.0, np.inf, 0.01) <= 2
    assert hill.looked_at == 2
    assert len(search.place) == 0


def test_above_the_limit_the_search_ends():
    hill, whole = Hill(), Hill()
    assert searched().largest(hill, 0.1, 0.5, 0.01) > 0.5
    searched().largest(whole, 0.1, np.inf, 0.01)
    assert hill.looked_at < whole.looked_at / 4


def test_a_search_goes_on_where_it_ended():
    search, hill, fresh = searched(), Hill(), Hill()
    search.largest(hill, 1.2, np.inf, 0.01)
    before = hill.looked_at
    assert 1 <= search.largest(hill, 0.1, np.inf, 0.01) <= 1.01
    searched().largest(fresh, 0.1, np.inf, 0.01)
    assert hill.looked_at - before < fresh.looked_at
    again = hill.looked_at
    search.largest(hill, 0.1, np.inf, 0.01)
    assert hill.looked_at == again


def test_nothing_has_no_value():
    assert PatchSearch(np.zeros((0, 3, 3))).largest(Hill(), 0.1, np.inf, 0.03) == 0


def test_more_patches_than_a_round_looks_at_still_have_a_bound(monkeypatch):
    """Those that nothing is known of come first, then the highest ones."""
    monkeypatch.setattr(patch_search, "_MOST_PATCHES", 3)
    search, hill = PatchSearch(np.repeat(SQUARE.astype(np.float64), 5, axis=0)), Hill()
    bound = search.largest(hill, 0.1, np.inf, 0.01)
    assert hill.looked_at > 10
    assert 1 <= bound <= 1.01


def test_with_too_many_patches_in_all_bounds_stand_as_they_are(monkeypatch):
    monkeypatch.setattr(patch_search, "_MOST_IN_ALL", 40)
    hill = Hill()
    assert 1.01 < searched().largest(hill, 0.1, np.inf, 0.01) < 2
    assert hill.looked_at < 2000
