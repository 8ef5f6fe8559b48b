import numpy as np
import pytest
from computed import parts_of
from shapes import dumbbell
from weak_convex_decomposition.core.parameters.choices import PICTURES
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.pictures import draw_picture

COLORS = np.array([[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]])
PARAMETERS = Parameters(samples=150, parts=3)


@pytest.fixture(params=["ALL_PAIRS", "CONE"])
def pictures(seen, request):
    memo = seen(dumbbell, parts=3, sight=request.param)
    labels = parts_of(memo, PARAMETERS).labels

    def draw(kind):
        return draw_picture(kind, memo, labels, PARAMETERS, COLORS).pixels

    return draw


def matrix(pixels):
    """Return the matrix of a picture, and the color of each of its rows."""
    times, rest = divmod(len(pixels), 162)  # 150 samples, and 12 for the colors
    assert rest == 0
    small = pixels[::times, ::times]
    return small[12:, 12:, 0], small[12:, 0]


@pytest.mark.parametrize("kind", [each.identifier for each in PICTURES])
def test_pictures_are_colors_of_a_size_to_look_at(pictures, kind):
    pixels = pictures(kind)
    height, width, channels = pixels.shape
    assert height == width >= 600
    assert channels == 3
    assert pixels.min() >= 0
    assert pixels.max() <= 1
    for color in COLORS:  # each part is there
        assert (pixels == color).all(axis=2).any()


@pytest.mark.parametrize("kind", ["SIGHT", "DISTANCES"])
def test_parts_are_dark_squares_of_a_symmetric_matrix(pictures, kind):
    grays, colors = matrix(pictures(kind))
    assert grays == pytest.approx(grays.T)
    assert (np.diag(grays) < 1e-6).all()
    same = (colors[:, None] == colors).all(axis=2)
    assert grays[same].mean() < grays[~same].mean() - 0.2
    changes = (colors[1:] != colors[:-1]).any(axis=1).sum()
    assert changes == 2  # sorted by part


def test_parts_lie_apart_in_the_scatter(pictures):
    pixels = pictures("SCATTER")
    middles = []
    for color in COLORS[:2]:
        rows, columns = np.nonzero((pixels == color).all(axis=2))
        middles.append([np.median(rows), np.median(columns)])
    assert np.linalg.norm(np.subtract(*middles)) > 200
