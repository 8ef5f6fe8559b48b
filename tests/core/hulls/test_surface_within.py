"""What of a surface lies within a collision shape."""

import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.hulls.convex_hull import THIN, convex_hull
from weak_convex_decomposition.core.hulls.fitting import fit_for
from weak_convex_decomposition.core.hulls.measure.surface_within import surface_within
from weak_convex_decomposition.core.hulls.solid import solid_of
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.steps.progress import run


@pytest.mark.parametrize(("kind", "area"), [("HULL", 0.5), ("SPHERE", np.pi / 4)])
def test_triangles_at_the_rim_are_clipped(kind, area):
    mesh = shapes.sheet(2)  # 1 x 1
    solid = run(solid_of(mesh, 0, 1.0))
    middle = solid.vertices.mean(axis=0)
    # An octahedron, which meets the sheet in a square, or the ball around it.
    corners = middle + np.concatenate([np.eye(3), -np.eye(3)]) / 2
    fit, _ = fit_for(mesh, HullParameters(shape=kind), 1.0)
    shape = fit.shape(convex_hull(corners, THIN))
    found = surface_within(solid, shape)
    a, b, c = np.moveaxis(found, 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    assert areas.sum() == pytest.approx(area, rel=0.03)
    assert shape.heights(found.reshape(-1, 3)).max() <= THIN / 5
