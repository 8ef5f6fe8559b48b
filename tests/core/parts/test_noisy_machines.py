"""Seams land on the rims of turned shapes, also where triangles are long and noisy."""

from itertools import pairwise

import numpy as np
import pytest
import shapes
from computed import decompose
from definitions import agreement
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.parameters.parts import Parameters

# Standard deviation of each coordinate, as a share of the diagonal.
NOISE = 0.002
AROUND = 32
# Rows of corners on each wall, at random heights; on rough caps, too.
ROWS = 3


def shaft():
    """Return the outline of a shaft with two steps."""
    return [(0, 0), (1, 0), (1, 2), (0.6, 2), (0.6, 4), (0.3, 4), (0.3, 6), (0, 6)]


def bush():
    """Return the outline of a sleeve with a bore, and of its flange."""
    outside = [(0, 0), (1.2, 0), (1.2, 0.5), (0.7, 0.5), (0.7, 2.5)]
    return [*outside, (0.45, 2.5), (0.45, 0.5), (0, 0.5)]


def bolt():
    """Return the outline of a head and a shank."""
    return [(0, 0), (1, 0), (1, 0.8), (0.5, 0.8), (0.5, 4), (0, 4)]


def rough(outline, seed, caps):
    """Return an outline turned around z, in triangles whose corners are noisy."""
    rng = np.random.default_rng(seed)
    line = [outline[0]]
    for start, end in pairwise(outline):
        shares = np.sort(rng.random(ROWS if caps or start[0] == end[0] else 0))
        line += [*(np.outer(1 - shares, start) + np.outer(shares, end)), end]
    mesh = shapes.turned(*np.transpose(line), AROUND)
    noise = NOISE * mesh.diagonal * rng.normal(size=mesh.vertices.shape)
    corners = mesh.vertices[mesh.triangles].mean(axis=1)
    numbers = np.arange(len(mesh.triangles))
    return TriangleMesh(mesh.vertices + noise, mesh.triangles, numbers), corners


@pytest.mark.parametrize(
    ("make", "rims", "caps"),
    [
        (shaft, [2, 4], False),
        (bush, [0.5], False),
        (bush, [0.5], True),
        (bolt, [0.8], False),
    ],
)
def test_parts_agree_with_steps(make, rims, caps):
    mesh, places = rough(make(), 0, caps)
    found = decompose(mesh, Parameters(samples=600))
    # The ring of a rim belongs to the wider step.
    steps = np.searchsorted(rims, places[:, 2] - 1e-9)
    assert found.n_parts == len(rims) + 1
    assert agreement(found.labels, steps, mesh.areas) >= 0.95
