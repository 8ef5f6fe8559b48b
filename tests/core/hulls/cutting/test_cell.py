import changes
import numpy as np
import pytest
import shapes
from computed import solid_of
from weak_convex_decomposition.core.hulls.cutting.cell import cut, whole
from weak_convex_decomposition.core.hulls.fitting import Fit
from weak_convex_decomposition.core.hulls.piece import join
from weak_convex_decomposition.core.parameters.hulls import HullParameters

CUBE = solid_of(shapes.box((-1, -1, -1), (1, 1, 1)))
PLANES = [np.array([*normal, 0.1]) for normal in np.eye(3)]


def cell_of(solid, max_error=0.05, **parameters):
    return whole(solid, Fit(HullParameters(**parameters), 1.0, max_error))


def test_a_corner_inside_the_solid_is_kept():
    cell, volume = cell_of(CUBE), 8.0
    for plane in PLANES:
        above = cut(cell, plane)[1]
        cell, volume = above, volume * 1.1 / 2
        assert cell.hull.volume == pytest.approx(volume, rel=1e-6)
        assert cell.volume == pytest.approx(volume, rel=0.05)
    assert cell.hull.vertices.min(axis=0) == pytest.approx([-0.1] * 3)


def test_both_sides_make_up_the_whole():
    solid = solid_of(changes.moved(shapes.u_shape(), scale=0.25))
    cell = cell_of(solid)
    below, above = cut(cell, np.array([1.0, 0.0, 0.0, -0.50001]))
    assert below.volume + above.volume == pytest.approx(cell.volume)
    assert len(below.boundary) + len(above.boundary) > len(cell.boundary)
    assert below.planes == pytest.approx(-above.planes)
    joint = join(below, above)
    assert len(joint.boundary) == len(cell.boundary)
    assert joint.volume == pytest.approx(cell.volume)
    assert joint.hull.volume == pytest.approx(cell.hull.volume)
    assert joint.error == pytest.approx(cell.error, abs=0.02)


def test_the_error_of_a_convex_piece_is_small():
    assert cell_of(CUBE).error < 0.05
    assert cell_of(solid_of(shapes.sphere(3))).error < 0.05


def test_what_is_too_deep_needs_no_bound():
    blocks = ((0, 20), (0, 20), (0, 17)), ((0, 8), (0, 20), (17, 20))
    groove = shapes.blocks((20, 20, 20), *blocks, ((12, 20), (0, 20), (17, 20)))
    solid = solid_of(changes.moved(groove, scale=0.1))
    assert solid.spacing > 0.02  # so that by estimates the error may be allowed
    deep = cell_of(solid, max_error=0.28)
    assert deep.error < 0.28 + solid.spacing
    assert not deep.may_be_close
    assert cell_of(solid, max_error=0.31).may_be_close
    # The shape that is written may be smaller than the one that depths are told from.
    for smaller in ({"shape": "BOX"}, {"max_vertices": 7}):
        assert cell_of(solid, max_error=0.28, **smaller).may_be_close


@pytest.mark.parametrize("depth", [0.2, 0.5, 0.8])
def test_the_error_of_a_slit_is_its_depth(depth):
    slit = shapes.blocks(
        (21, 20, 20),
        ((0, 10), (0, 20), (0, 20)),
        ((11, 21), (0, 20), (0, 20)),
        ((0, 21), (0, 20), (0, round(20 * (1 - depth)))),
    )
    solid = solid_of(changes.moved(slit, scale=2 / 21))
    cell = cell_of(solid)
    # Of the slit's floor and, its own samples aside, nothing is nearer to the hull.
    expected = min(20 * depth * 2 / 21, 10 * 2 / 21)
    assert cell.error == pytest.approx(expected, abs=0.08)
