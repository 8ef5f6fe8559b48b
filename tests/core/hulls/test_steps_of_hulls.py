"""No step of a dense mesh does more than one costly thing, whatever the clock says."""

from dataclasses import replace

import numpy as np
import pytest
import shapes
from computed import BruteCaster, ShapeCache
from weak_convex_decomposition.core.geometry.primitives import Hull
from weak_convex_decomposition.core.hulls import convex_hull
from weak_convex_decomposition.core.hulls.build import build_hulls_in_steps
from weak_convex_decomposition.core.hulls.measure import line_crossings
from weak_convex_decomposition.core.hulls.measure.inside import InsideTest
from weak_convex_decomposition.core.parameters.hulls import HullParameters


def crossing_balls():
    """Return two balls that run through each other, and one within the first."""
    ball = shapes.sphere(4)
    moved = replace(ball, vertices=ball.vertices + np.array([0.5, 0, 0]))
    return shapes.joined(ball, moved, replace(ball, vertices=0.9 * ball.vertices))


def dense_hulls(points):
    """Return 1 for the hull of many points, else 0."""
    return int(len(points) > 1000)


def tables(flat, _):
    """Return 1 for the table of many triangles, else 0."""
    return int(flat.shape[2] > 1000)


def heights(hull, corners):
    """Return how many heights of corners above planes are computed."""
    return corners.shape[0] * corners.shape[1] * len(hull.planes)


def places(_, points):
    """Return how many points are looked at."""
    return len(points)


@pytest.mark.parametrize(
    ("owner", "name", "work", "most"),
    [
        (convex_hull, "ConvexHull", dense_hulls, 1),
        (line_crossings, "_table", tables, 1),
        (Hull, "heights_of_patches", heights, 6_000_000),
        (InsideTest, "holds", places, 1000),
    ],
)
def test_no_step_does_more_than_so_much(monkeypatch, owner, name, work, most):
    kept, done, largest = getattr(owner, name), [0], 0

    def counted(*arguments):
        done[0] += work(*arguments)
        return kept(*arguments)

    monkeypatch.setattr(owner, name, counted)
    cache = ShapeCache(BruteCaster)
    for _ in build_hulls_in_steps(crossing_balls(), HullParameters(), cache):
        largest, done[0] = max(largest, done[0]), 0
    assert 0 < max(largest, done[0]) <= most
