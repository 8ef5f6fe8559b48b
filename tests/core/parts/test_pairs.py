"""Parts that are mirror images of each other across X."""

import numpy as np
import shapes
from changes import moved
from computed import see
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.pairs import mirror_pairs
from weak_convex_decomposition.core.steps.progress import run

QUARTER = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


def centers(mesh):
    corners = mesh.vertices[mesh.triangles].mean(axis=1)
    return np.array(
        [corners[mesh.polygons == p].mean(axis=0) for p in range(mesh.n_polygons)]
    )


def thirds(mesh, axis):
    """Return labels: 0 in the middle along an axis, 1 below and 2 above."""
    heights = centers(mesh)[:, axis]
    middle, size = (heights.max() + heights.min()) / 2, np.ptp(heights)
    sides = np.sign(np.round((heights - middle) / size * 2.9)).astype(int)
    return np.array([0, 2, 1])[sides]


def longest(mesh):
    return int(np.ptp(mesh.vertices, axis=0).argmax())


def dumbbell_along(axis):
    """Return a dumbbell with its knobs along an axis."""
    mesh = shapes.dumbbell()
    for _ in range(3):
        if longest(mesh) == axis:
            return mesh
        turn = QUARTER if longest(mesh) < 2 else QUARTER[[0, 2, 1]][:, [0, 2, 1]]
        mesh = moved(mesh, rotation=turn)
    raise AssertionError


def pairs_of(mesh, labels):
    memo = see(mesh, Parameters(samples=60))
    return run(mirror_pairs(memo, labels))


def test_the_knobs_of_a_dumbbell_along_x_are_a_pair_the_one_at_larger_x_first():
    mesh = dumbbell_along(0)
    assert pairs_of(mesh, thirds(mesh, 0)) == ((2, 1),)


def test_parts_of_a_shape_that_is_symmetric_across_x_but_cut_otherwise_are_no_pair():
    mesh = dumbbell_along(0)
    x = centers(mesh)[:, 0]
    above = (x > x.min() + 0.8 * np.ptp(x)).astype(int)
    assert pairs_of(mesh, above) == ()


def test_one_part_has_no_pair():
    mesh = dumbbell_along(0)
    assert pairs_of(mesh, np.zeros(mesh.n_polygons, dtype=int)) == ()
