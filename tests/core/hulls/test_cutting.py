"""Which cuts of a solid are made, and which are undone."""

import numpy as np
import pytest
import shapes
from computed import build_hulls
from weak_convex_decomposition.core.parameters.hulls import HullParameters


@pytest.mark.parametrize(
    ("kind", "n_shapes", "error"),
    [("BOX", 1, 0.0), ("SPHERE", 8, np.sqrt(3) / 2 - 0.5), ("CYLINDER", 4, 0.2072)],
)
def test_a_cube_is_cut_where_that_lowers_the_error(kind, n_shapes, error):
    # Spheres around halves stray farther than one around all, those of eighths less.
    values = {"shape": kind, "max_hulls": 12, "max_error": 0.02}
    found = build_hulls(shapes.box(), HullParameters(**values))
    assert found.n_hulls == n_shapes
    assert found.errors.max() == pytest.approx(error, rel=0.05, abs=1e-6)
    assert bool(found.notes) == (kind != "BOX")
