"""What the sidebar shows where there is not room for all."""

import pytest
from weak_convex_decomposition.ui.hulls_panel import endings
from weak_convex_decomposition.ui.parts_table import headings

# At interface scale 1, in points: Blender's own, and others that are dragged to.
_USUAL = 280
HULLS = [{"part": 0, "error": 0.1}]


@pytest.mark.parametrize(
    ("hulls", "width", "expected"),
    [
        ([], _USUAL, ["Faces", "Rank"]),
        (HULLS, _USUAL, ["Rank", "Hull"]),
        (HULLS, 2 * _USUAL, ["Faces", "Area", "Rank", "Hull"]),
        (HULLS, 220, ["Rank"]),
        ([], 1, ["Rank"]),
    ],
)
def test_the_table_has_the_figures_that_there_is_room_for(hulls, width, expected):
    assert headings(hulls, width) == expected


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
