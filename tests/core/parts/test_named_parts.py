import numpy as np
import pytest
import shapes
from computed import graph_of, split_up
from definitions import agreement
from weak_convex_decomposition.core.parameters.parts import Parameters


def assert_names(decomposition, mesh, expected, at_least=0.9):
    """Check that parts agree with the labels that anyone would give the polygons."""
    surface = graph_of(mesh)
    numbers = expected(*surface.centers.T).astype(int)
    assert decomposition.n_parts == numbers.max() + 1
    assert agreement(decomposition.labels, numbers, surface.areas) >= at_least


CONVEX = {
    "box": shapes.box,
    "fine box": lambda: shapes.box(divisions=3),
    "long box": lambda: shapes.box((0, 0, 0), (5, 1, 1), 2),
    "sphere": lambda: shapes.sphere(1),
    "quads": shapes.uv_sphere,
    "one triangle": lambda: shapes.mesh_of(np.eye(3), [(0, 1, 2)]),
    "sheet": shapes.sheet,
}


@pytest.mark.parametrize("make", CONVEX.values(), ids=CONVEX)
def test_a_convex_shape_is_one_part_of_rank_one(decomposed, make):
    found = decomposed(make)
    assert found.n_parts == 1
    assert found.ranks.tolist() == [1.0]
    assert found.psi == found.psi_before == found.psi_by_k[1] == 1.0
    assert not found.labels.any()
    assert found.notes == ()


def test_an_l_has_two_arms(decomposed):
    assert_names(
        decomposed(shapes.l_shape),
        shapes.l_shape(),
        lambda x, y, z: x > y,
        0.85,
    )


def test_an_l_of_two_overlapping_boxes_has_two_arms():
    one, other = shapes.box((0, 0, 0), (5, 1, 1), 3), shapes.box((0,) * 3, (1, 5, 1), 3)
    mesh = shapes.joined(one, other)
    found = split_up(mesh, samples=300)
    assert_names(found, mesh, lambda x, y, z: np.arange(len(x)) >= 54, 0.75)


def tips_of_a_plus(found):
    """Return the part of each tip: at low and high x, at low and high y."""
    surface = graph_of(shapes.plus())
    x, y, _ = surface.centers.T
    parts = [set(found.labels[tip]) for tip in (x < 2, x > 6, y < 2, y > 6)]
    assert [len(each) for each in parts] == [1] * 4
    return [each.pop() for each in parts]


def test_a_plus_has_a_bar_and_two_arms(decomposed):
    found = decomposed(shapes.plus)
    left, right, low, high = tips_of_a_plus(found)
    assert found.n_parts == 3
    assert (left == right) != (low == high)  # either bar may be the whole one
    assert found.areas == pytest.approx([64, 28, 28])
    assert found.ranks.tolist() == [1, 1, 1]


@pytest.mark.parametrize("seed", range(1, 6))
def test_neighboring_tips_of_a_plus_never_share_a_part(seed):
    found = split_up(shapes.plus(), max_parts=6, seed=seed)
    left, right, low, high = tips_of_a_plus(found)
    assert not {left, right} & {low, high}
    assert left == right or low == high
    # The bars are all of it, except for a few faces where they cross.
    bars = sum(found.areas[part] for part in {left, right, low, high})
    assert bars >= 116
    assert found.ranks.min() > 0.99


def test_a_dumbbell_has_two_weights_and_a_bar(decomposed):
    def expected(x, y, z):
        return np.select([x < 3 + 1e-6, x > 6 - 1e-6], [0, 1], 2)

    found, mesh = decomposed(shapes.dumbbell), shapes.dumbbell()
    assert_names(found, mesh, expected, 0.999)


def test_a_table_has_a_top_and_four_legs(decomposed):
    def expected(x, y, z):
        return np.where(z > 3 - 1e-6, 0, 1 + (x > 2.5) + 2 * (y > 2))

    found = decomposed(shapes.table)
    assert_names(found, shapes.table(), expected, 0.97)
    assert found.ranks.min() > 0.95


def test_a_hand_has_a_palm_and_four_fingers(decomposed):
    def expected(x, y, z):
        return np.where(y > 3 + 1e-6, 1 + x // 2, 0)

    found = decomposed(shapes.comb)
    assert_names(found, shapes.comb(), expected, 0.999)


def test_a_u_has_a_base_and_two_legs(decomposed):
    def expected(x, y, z):
        return np.select([y < 2 + 1e-6, x < 4], [0, 1], 2)

    found = decomposed(shapes.u_shape)
    assert_names(found, shapes.u_shape(), expected, 0.9)


def test_spheres_far_apart_are_a_part_each():
    mesh = shapes.joined(shapes.sphere(1), shapes.sphere(1, 0.9, (50, 0, 0)))
    found = split_up(mesh)
    assert found.labels.tolist() == [0] * 80 + [1] * 80
    assert found.ranks.tolist() == [1, 1]
    # All that is visible is within parts, all that is hidden across them.
    rank = found.psi_before
    assert found.psi == pytest.approx(rank + Parameters().alpha * (1 - rank))
    assert found.psi_before == pytest.approx(0.5, abs=0.02)


# Only cones estimate psi from rays.
@pytest.mark.parametrize(
    ("sight", "psi_pairs"),
    [("ALL_PAIRS", "UNIFORM"), ("CONE", "UNIFORM"), ("CONE", "RAYS")],
)
@pytest.mark.parametrize("normalization", ["LAPLACIAN", "STOCHASTIC"])
def test_every_way_to_look_finds_the_spheres(sight, normalization, psi_pairs):
    mesh = shapes.joined(shapes.sphere(0), shapes.sphere(0, 0.9, (3, 0, 0)))
    found = split_up(
        mesh,
        sight=sight,
        normalization=normalization,
        psi_pairs=psi_pairs,
        samples=100,
        parts=2,
    )
    assert found.labels.tolist() == [0] * 20 + [1] * 20
