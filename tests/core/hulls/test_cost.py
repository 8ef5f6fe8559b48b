"""What hulls cost, and the bounds that save looking at most of them."""

import changes
import numpy as np
import pytest
import shapes
from computed import solid_of
from weak_convex_decomposition.core.hulls.cost import (
    cost_of_joint,
    cost_of_sides,
    least_cost,
)
from weak_convex_decomposition.core.hulls.cutting.cell import cut, whole
from weak_convex_decomposition.core.hulls.fitting import Fit
from weak_convex_decomposition.core.hulls.piece import join
from weak_convex_decomposition.core.parameters.hulls import HullParameters

PLANES = [np.array([*np.eye(3)[axis], -place]) for axis in (0, 1) for place in (0.4, 1)]


@pytest.fixture(scope="module", params=[shapes.u_shape, shapes.comb, shapes.table])
def sides(request):
    """Return both sides of some cuts of a shape, and the shape's volume."""
    solid = solid_of(changes.moved(request.param(), scale=0.25))
    piece = whole(solid, Fit(HullParameters(), 1.0, 0.05))
    return [cut(piece, plane) for plane in PLANES], piece.volume


def test_bounds_are_below_what_they_bound(sides):
    pairs, volume = sides
    for one, other in pairs:
        joint = join(one, other)
        cost = cost_of_joint(joint, joint.error, volume)
        assert 0 <= least_cost(one, other, volume) <= cost
        pair = one, other
        both = cost_of_sides(pair, [side.error for side in pair], volume)
        least = cost_of_sides(pair, [side.least_error for side in pair], volume)
        assert 0 <= least <= both


def test_what_hulls_add_costs_its_share_of_the_solid(sides):
    """A solid of half the volume makes the same addition twice as dear."""
    pairs, volume = sides
    for one, other in pairs:
        joint = join(one, other)
        assert joint.added_volume > 0
        dearer = cost_of_joint(joint, 0.1, volume / 2)
        dearer -= cost_of_joint(joint, 0.1, volume)
        assert dearer == pytest.approx(joint.added_volume / volume, abs=1e-5)
        added = max(one.added_volume, 0) + max(other.added_volume, 0)
        dearer = cost_of_sides((one, other), (0.1, 0.2), volume / 2)
        dearer -= cost_of_sides((one, other), (0.1, 0.2), volume)
        assert dearer == pytest.approx(added / volume, abs=1e-5)


def test_where_the_solid_has_no_volume_errors_and_cuts_alone_cost(sides):
    (one, other), *_ = sides[0]
    errors = one.error, other.error
    cuts = 0.1 * (one.cut_share + other.cut_share)
    cost = np.linalg.norm(errors, 1.75) + cuts
    assert cost_of_sides((one, other), errors, 0.0) == pytest.approx(cost, abs=1e-6)


def test_a_cut_across_the_longest_side_is_the_smallest():
    solid = solid_of(changes.moved(shapes.l_prism(3.0), scale=0.25))
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    piece, middle = whole(solid, Fit(HullParameters(), 1.0, 0.05)), (low + high) / 2
    shares = [
        sum(side.cut_share for side in cut(piece, np.append(normal, -normal @ middle)))
        for normal in np.eye(3)
    ]
    assert 0 < shares[(high - low).argmax()] == min(shares)
