import changes
import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.hulls.convex_hull import hull_volume
from weak_convex_decomposition.core.hulls.cutting.extremes import (
    reaches_of,
    volumes_beside,
)


def beside(points, *ends):
    return volumes_beside(points, reaches_of(points), np.array(ends))


@pytest.mark.parametrize("seed", range(5))
def test_volumes_are_nearly_those_of_hulls(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(600, 3))
    points = points[np.argsort(points[:, 2])]
    below, above = beside(points, 50, 300, 500)
    for k, end in enumerate((50, 300, 500)):
        # Within: some corners are farthest in no direction that is looked at.
        for volume, part in ((below[k], points[:end]), (above[k], points[end:])):
            assert 0.85 * hull_volume(part) < volume < hull_volume(part) * (1 + 1e-9)


def test_the_volume_of_a_box_is_exact():
    corners = shapes.box((0, 0, 0), (3, 2, 1)).vertices @ changes.any_rotation(1).T + 9
    below, above = beside(corners, 8)
    assert below == pytest.approx([6])
    assert above == pytest.approx([0])


def test_nothing_has_no_volume():
    points = np.random.default_rng(0).random((20, 3))
    below, above = beside(points, 0, 0, 20)
    assert (below[:2] == 0).all()
    assert above[2] == 0
    assert above[0] == below[2] > 0
