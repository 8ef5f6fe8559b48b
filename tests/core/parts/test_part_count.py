"""How far alpha moves the number of parts that a search chooses."""

import pytest
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.part_count import gain_tolerance


def test_the_tolerance_is_that_of_the_default_for_all_smaller_alphas():
    default = gain_tolerance(Parameters().alpha)
    assert default == 0.035
    assert [gain_tolerance(alpha) for alpha in (0.0, 0.2, 1.0)] == [default] * 3


@pytest.mark.parametrize("alpha", [2.0, 3.0, 5.0])
def test_with_twice_the_alpha_half_of_the_gain_may_be_missing(alpha):
    assert gain_tolerance(2 * alpha) == pytest.approx(gain_tolerance(alpha) / 2)
