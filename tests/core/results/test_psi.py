"""The word for psi, and good numbers of parts by it."""

import numpy as np
import pytest
from weak_convex_decomposition.core.results.psi import (
    good_numbers,
    quality_word,
    still_rises,
)
from weak_convex_decomposition.core.sight.pair_tally import PairTally

# Two blobs of 10 samples that see nothing of each other: half of all pairs are visible.
APART = PairTally(np.diag([100.0, 100.0]), np.full((2, 2), 100.0))


@pytest.mark.parametrize("alpha", [0.0, 0.5, 2.0, 10.0])
def test_parts_that_split_all_hidden_pairs_and_no_visible_one_are_very_good(alpha):
    before = APART.merged(0, 1).psi(alpha)
    assert before == 0.5
    assert quality_word(APART.psi(alpha), before, alpha) == "Very Good"


def test_a_whole_that_hides_half_of_itself_is_poor_and_a_convex_one_very_good():
    assert quality_word(0.5, 0.5, 2.0) == "Poor"
    assert quality_word(1.0, 1.0, 2.0) == "Very Good"


@pytest.mark.parametrize(
    ("share", "word"),
    [
        *((1.0, "Very Good"), (0.851, "Very Good"), (0.849, "Good"), (0.751, "Good")),
        *((0.749, "Fair"), (0.601, "Fair"), (0.599, "Poor"), (0.0, "Poor")),
    ],
)
def test_words_begin_at_their_shares_of_the_largest_psi(share, word):
    before, alpha = 0.553, 2.0
    assert quality_word(share * (before + alpha * (1 - before)), before, alpha) == word


def test_shapes_of_which_nothing_is_seen_have_a_word_too():
    assert quality_word(0.0, 0.0, 0.0) == "Very Good"


@pytest.mark.parametrize(
    ("best", "expected"),
    [(4, (3, 4, 8)), (3, (3, 6)), (2, (2, 4)), (8, (3, 8)), (1, (1,)), (20, (20,))],
)
def test_good_numbers_are_a_coarse_one_the_best_and_a_fine_one(best, expected):
    gains = (0.0, 0.5, 0.8, 0.96, 0.94, 0.97, 0.96, 1.0, 0.99)
    psi_by_k = {k: 0.25 + 0.5 * gain for k, gain in enumerate(gains, start=1)}
    assert good_numbers(psi_by_k, best) == expected


def test_one_part_is_good_only_where_more_gain_nothing():
    """Psi may fall with the number of parts below that of one: a small Detail."""
    assert good_numbers({1: 0.5, 2: 0.52, 12: 0.3}, 2) == (2,)


@pytest.mark.parametrize(
    ("by_part", "best", "expected"),
    [
        (0.1, 13, True),  # the last number is the best
        (0.1, 12, True),  # each part gains the same
        (0.01, 10, False),  # the last ones gain an eighth
        (-0.1, 9, False),
    ],
)
def test_psi_rises_where_the_last_parts_gain_like_others(by_part, best, expected):
    psi_by_k = {k: 0.1 * min(k, 10) + by_part * max(k - 10, 0) for k in range(1, 14)}
    assert still_rises(psi_by_k, best, 13) == expected
    assert not still_rises(psi_by_k, best, 14)
