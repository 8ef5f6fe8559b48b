"""What the sidebar shows where there is not room for all."""

import pytest
from stand_ins.layout import EDGES, ICON
from weak_convex_decomposition.ui.chart import (
    details_of,
    gains_of,
    offer_of,
    reason_for,
    share_of_numbers,
)
from weak_convex_decomposition.ui.edit_panel import fitting
from weak_convex_decomposition.ui.hulls_panel import endings, error_text
from weak_convex_decomposition.ui.parts_table import brief, headings

# At interface scale 1, in points: Blender's own, and others that are dragged to.
_USUAL = 280
HULLS = [{"part": 0, "error": 0.1}]


@pytest.mark.parametrize(
    ("hulls", "width", "expected"),
    [
        ([], _USUAL, ["Faces", "Rank"]),
        (HULLS, _USUAL, ["Rank", "Hull"]),
        (HULLS, 2 * _USUAL, ["Faces", "Area", "Rank", "Hull"]),
        (HULLS, 230, ["Rank"]),
        (HULLS, 188, []),
        ([], 1, []),
    ],
)
def test_the_table_has_the_figures_that_there_is_room_for(hulls, width, expected):
    assert headings(hulls, width, n_rows=9) == expected


def test_a_scroll_bar_takes_room_from_the_figures():
    assert headings([], _USUAL, n_rows=9) == ["Faces", "Rank"]
    assert headings([], _USUAL, n_rows=10) == ["Rank"]


@pytest.mark.parametrize(
    ("figure", "in_parts", "in_hulls"),
    [
        (0.0, "0.00", "0"),
        (6.1234e-5, "6e-5", "6.1e-5"),
        (0.00312, "3e-3", "0.00312"),
        (0.0881, "0.09", "0.0881"),
        (12.34, "12.3", "12.3"),
        (1234.0, "1234", "1.2e3"),
        (60954.0, "6e4", "6.1e4"),
        (2.5e11, "2e11", "2.5e11"),
    ],
)
def test_figures_of_tiny_and_huge_objects_are_not_cut(figure, in_parts, in_hulls):
    assert (brief(figure), error_text(figure)) == (in_parts, in_hulls)


@pytest.mark.parametrize("width", [1, 202, _USUAL, 2 * _USUAL])
def test_numbers_with_a_star_are_not_cut_in_the_chart(width):
    share = share_of_numbers(width)
    assert 0.2 < share <= 1
    assert width < EDGES or share * (width - EDGES) > ICON + 2 * 14


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (["Jaw"], "Split Jaw"),
        (["Jaw", "Head"], "Split 2 Parts"),
        (["The Left Ear of Suzanne"], "Split The Left E…"),
        ([], "Split"),
    ],
)
def test_names_are_shortened_where_a_button_has_no_room(names, expected):
    assert fitting("Split", names, room=90) == expected


@pytest.mark.parametrize(
    ("best", "gains", "words"),
    [
        (5, {1: 0.0, 5: 0.98, 10: 1.0}, "5 is best: 10 gain only 2% more."),
        (5, {1: 0.0, 5: 0.999, 7: 1.0}, "7 gain less than 1% more."),
        (7, {1: 0.0, 5: 1.0, 7: 0.98}, "5 gain only 2% more, but split less"),
        (5, {1: 0.0, 5: 0.4, 12: 1.0}, "12 gain 60% more, but ignore creases."),
        (5, {1: 0.0, 5: 1.0, 10: 0.9}, None),
    ],
)
def test_the_chart_says_why_the_longest_bar_is_not_the_best(best, gains, words):
    reason = reason_for(best, gains)
    assert reason is None if words is None else words in reason


@pytest.mark.parametrize(
    ("good", "text"),
    [
        ([3, 6, 11], "Coarse to fine: 3, 6 or 11 parts."),
        ([2, 4], "Coarse to fine: 2 or 4 parts."),
        ([1], None),
        ((), None),
    ],
)
def test_the_chart_tells_good_numbers(good, text):
    assert offer_of(good) == text


@pytest.mark.parametrize(
    ("levels", "k", "text"),
    [
        (0, 23, "8 parts of the whole, and 15 more in their details."),
        (0, 8, None),
        (1, 9, None),
        (2, 23, None),
    ],
)
def test_the_chart_tells_parts_of_details_from_others(levels, k, text):
    parameters = {"parts": 0, "levels": levels}
    assert details_of({"parameters": parameters, "k": k, "best_k": 8}) == text


def test_bars_are_shares_of_the_largest_gain():
    assert gains_of({10: 1.5, 2: 1.0, 1: 0.5}) == {1: 0.0, 2: 0.5, 10: 1.0}
    assert gains_of({1: 1.0, 2: 1.0}) == {1: 1.0, 2: 1.0}


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (["Chair hull 01", "Chair hull 02", "Chair hull 10"], ["01", "02", "10"]),
        (["UCX_Chair_01", "UCX_Chair_02"], ["01", "02"]),
        (["UCX_Chair_01", "UBX_Chair_02"], ["UCX_Chair_01", "UBX_Chair_02"]),
        (["Chair hull 01"], ["Chair hull 01"]),
        ([], []),
    ],
)
def test_hulls_are_told_apart_by_the_ends_of_their_names(names, expected):
    assert endings(names) == expected
