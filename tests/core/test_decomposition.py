from dataclasses import replace

import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from scipy.optimize import linear_sum_assignment
from weak_convex_decomposition.core.decomposition import decompose, find_parts
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters import Parameters
from weak_convex_decomposition.core.progress import run
from weak_convex_decomposition.core.shapes import TriangleMesh
from weak_convex_decomposition.core.surface import surface_of


def split_up(mesh, **values):
    values = {"samples": 150, "max_parts": 5, **values}
    return run(decompose(mesh, Parameters(**values), BruteCaster))


def agreement(labels, others, areas):
    """Return the share of the area on which two partitions agree, best matched."""
    overlaps = np.zeros((labels.max() + 1, others.max() + 1))
    np.add.at(overlaps, (labels, others), areas)
    rows, columns = linear_sum_assignment(-overlaps)
    return overlaps[rows, columns].sum() / areas.sum()


def assert_names(decomposition, mesh, expected, at_least=0.9):
    """Check that parts agree with the labels that anyone would give the polygons."""
    surface = surface_of(mesh)
    numbers = expected(*surface.centers.T).astype(int)
    assert decomposition.n_parts == numbers.max() + 1
    assert agreement(decomposition.labels, numbers, surface.areas) >= at_least


# Parts that anyone would name.


CONVEX = {
    "box": shapes.box,
    "fine box": lambda: shapes.box(divisions=4),
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
        decomposed(shapes.l_shape), shapes.l_shape(), lambda x, y, z: x > y, 0.85
    )


def test_an_l_of_two_overlapping_boxes_has_two_arms():
    one, other = shapes.box((0, 0, 0), (5, 1, 1), 4), shapes.box((0,) * 3, (1, 5, 1), 4)
    mesh = shapes.joined(one, shapes.moved(other, 0.98, offset=(0.01, 0.01, 0.01)))
    found = split_up(mesh)
    assert_names(found, mesh, lambda x, y, z: np.arange(len(x)) >= 96, 0.8)


def test_a_plus_has_a_bar_and_two_arms_or_four_arms(decomposed):
    found, surface = decomposed(shapes.plus), surface_of(shapes.plus())
    assert found.n_parts in (2, 3, 4, 5)
    x, y, _ = surface.centers.T
    tips = [x < 2, x > 6, y < 2, y > 6]
    for tip in tips:
        areas = np.bincount(found.labels[tip], surface.areas[tip])
        assert areas.max() / areas.sum() > 0.95
    assert found.labels[tips[0]][0] != found.labels[tips[2]][0]
    assert found.ranks.min() > 0.9


def test_a_dumbbell_has_two_weights(decomposed):
    found, surface = decomposed(shapes.dumbbell), surface_of(shapes.dumbbell())
    assert found.n_parts in (2, 3)
    x = surface.centers[:, 0]
    left, right = found.labels[x < 2.9], found.labels[x > 6.1]
    assert len(set(left)) == len(set(right)) == 1
    assert left[0] != right[0]
    if found.n_parts == 3:
        bar = found.labels[(x > 3.1) & (x < 5.9)]
        assert (bar == 2).mean() > 0.9


def test_a_table_has_a_top_and_four_legs(decomposed):
    def expected(x, y, z):
        return np.where(z > 3 - 1e-6, 0, 1 + (x > 2.5) + 2 * (y > 2))

    found = decomposed(shapes.table)
    assert_names(found, shapes.table(), expected, 0.97)
    assert found.ranks.min() > 0.95


def test_a_hand_has_a_palm_and_four_fingers(decomposed):
    found, surface = decomposed(shapes.comb), surface_of(shapes.comb())
    assert found.n_parts in (4, 5)
    x, y, _ = surface.centers.T
    fingers = [
        set(found.labels[(y > 4) & (np.abs(x - c) < 0.6)]) for c in (0.5, 2.5, 4.5, 6.5)
    ]
    assert all(len(finger) == 1 for finger in fingers)
    assert len(set.union(*fingers)) == 4


def test_a_u_has_its_legs_apart(decomposed):
    found, surface = decomposed(shapes.u_shape), surface_of(shapes.u_shape())
    assert found.n_parts in (2, 3)
    x, y, _ = surface.centers.T
    left, right = found.labels[(x < 3) & (y > 3)], found.labels[(x > 5) & (y > 3)]
    assert len(set(left)) == len(set(right)) == 1
    assert left[0] != right[0]


def test_spheres_far_apart_are_a_part_each():
    mesh = shapes.joined(shapes.sphere(1), shapes.sphere(1, 0.9, (50, 0, 0)))
    found = split_up(mesh)
    assert found.labels.tolist() == [0] * 80 + [1] * 80
    assert found.ranks.tolist() == [1, 1]
    assert found.psi == 1.0
    assert found.psi_before == pytest.approx(0.5, abs=0.02)


@pytest.mark.parametrize("sight", ["ALL_PAIRS", "CONE"])
@pytest.mark.parametrize("normalization", ["LAPLACIAN", "STOCHASTIC"])
@pytest.mark.parametrize("psi_pairs", ["UNIFORM", "RAYS"])
def test_every_way_to_look_finds_the_spheres(sight, normalization, psi_pairs):
    if sight == "ALL_PAIRS" and psi_pairs == "RAYS":
        pytest.skip("only cones estimate psi from rays")
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


# What must not matter.


def same_partition(found, other, areas, polygons=None):
    labels = other.labels if polygons is None else other.labels[polygons]
    assert found.n_parts == other.n_parts
    return agreement(found.labels, labels, areas) >= 0.97


@pytest.fixture(scope="module")
def table():
    mesh = shapes.table()
    return mesh, surface_of(mesh).areas


SAME = {"max_parts": 7}


@pytest.mark.parametrize("seed", range(2))
def test_the_same_parts_after_a_rotation(decomposed, table, seed):
    mesh, areas = table
    turned = shapes.moved(mesh, rotation=shapes.any_rotation(seed), offset=(9, 2, 5))
    assert same_partition(decomposed(shapes.table), split_up(turned, **SAME), areas)


@pytest.mark.parametrize("scale", [1000.0, 0.001])
def test_the_same_parts_at_another_scale(decomposed, table, scale):
    mesh, areas = table
    found, scaled = (
        decomposed(shapes.table),
        split_up(shapes.moved(mesh, scale), **SAME),
    )
    assert same_partition(found, scaled, areas)
    assert scaled.areas == pytest.approx(found.areas * scale**2, rel=0.03)
    assert scaled.areas.sum() == pytest.approx(areas.sum() * scale**2)


def test_the_same_parts_of_shuffled_faces(decomposed, table):
    mesh, areas = table
    shuffled, polygons = shapes.permuted(mesh, 5)
    found = split_up(shuffled, **SAME)
    assert same_partition(decomposed(shapes.table), found, areas, polygons)


def test_the_same_parts_of_split_vertices(decomposed, table):
    mesh, areas = table
    found = split_up(shapes.split(mesh), **SAME)
    assert same_partition(decomposed(shapes.table), found, areas)


def test_the_same_parts_of_an_inside_out_mesh_with_a_note(decomposed, table):
    mesh, areas = table
    found = split_up(shapes.inside_out(mesh), **SAME)
    assert same_partition(decomposed(shapes.table), found, areas)
    assert len(found.notes) == 1
    assert "inside out" in found.notes[0]


def test_the_same_parts_of_a_finer_tessellation(decomposed):
    """Each triangle in four, each a polygon of its own."""
    mesh = shapes.l_shape()
    finer = shapes.refined(mesh)
    finer = replace(finer, polygons=np.arange(len(finer.triangles)))
    coarse, fine = decomposed(shapes.l_shape), split_up(finer)
    assert coarse.n_parts == fine.n_parts
    labels = coarse.labels[np.repeat(mesh.polygons, 4)]
    assert agreement(labels, fine.labels, finer.areas) >= 0.9


def test_the_same_parts_of_triangles_for_polygons(decomposed, table):
    mesh, _ = table
    triangles = replace(mesh, polygons=np.arange(len(mesh.triangles)))
    found = split_up(triangles, **SAME)
    labels = decomposed(shapes.table).labels[mesh.polygons]
    assert agreement(labels, found.labels, mesh.areas) >= 0.97


def test_a_crate_of_twelve_triangles_is_a_crate_of_many_quads():
    coarse = shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1)))
    fine = shapes.joined(
        shapes.box(divisions=4), shapes.box((3, 0, 0), (4, 1, 1), divisions=4)
    )
    found = [split_up(mesh, parts=2) for mesh in (coarse, fine)]
    for mesh, decomposition in zip((coarse, fine), found, strict=True):
        left = surface_of(mesh).centers[:, 0] < 2
        assert len(set(decomposition.labels[left])) == 1
        assert len(set(decomposition.labels[~left])) == 1
    assert found[0].areas == pytest.approx(found[1].areas)


@pytest.mark.parametrize(
    ("make", "parts"),
    [
        (shapes.comb, 0),
        (shapes.comb, 8),
        (shapes.box, 4),
        (lambda: shapes.box(divisions=4), 4),
        (lambda: shapes.sphere(1), 3),
        (lambda: shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1))), 0),
        (lambda: shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1))), 5),
    ],
    ids=["hand", "hand in 8", "box", "fine box", "sphere", "two", "two in 5"],
)
def test_the_same_seed_gives_the_same_labels(make, parts):
    first = split_up(make(), parts=parts, samples=100)
    split_up(shapes.l_prism(), samples=50)
    second = split_up(make(), parts=parts, samples=100)
    assert (first.labels == second.labels).all()
    assert (first.psi, first.psi_by_k) == (second.psi, second.psi_by_k)


# What a decomposition says of itself.


@pytest.mark.parametrize("make", [shapes.comb, shapes.plus, shapes.dumbbell])
def test_the_figures_agree_with_each_other(decomposed, make):
    found, surface = decomposed(make), surface_of(make())
    labels = found.labels
    assert labels.shape == (surface.n_polygons,)
    assert set(labels) == set(range(found.n_parts))
    assert found.face_counts.tolist() == np.bincount(labels).tolist()
    assert found.areas == pytest.approx(np.bincount(labels, surface.areas))
    assert (np.diff(found.areas) <= 1e-9).all()
    assert ((found.ranks >= 0) & (found.ranks <= 1)).all()
    assert found.psi_by_k[1] == found.psi_before
    assert found.psi_by_k[found.n_parts] == max(found.psi_by_k.values())
    assert found.psi > found.psi_before
    assert found.psi == pytest.approx(found.psi_by_k[found.n_parts], abs=0.1)


def test_a_given_number_of_parts_has_its_psi(seen):
    found = run(find_parts(seen(shapes.comb), Parameters(samples=150, parts=4)))
    assert found.n_parts == 4
    assert set(found.psi_by_k) == {1, 4}
    assert found.notes == ()


def test_the_balance_decides_how_far_to_split(seen):
    counts = [
        run(find_parts(seen(shapes.comb), Parameters(samples=150, alpha=alpha))).n_parts
        for alpha in (0.0, 1.0, 10.0)
    ]
    assert counts[0] == 1
    assert counts == sorted(counts)
    assert counts[2] > 1


@pytest.mark.parametrize(
    "make",
    [shapes.box, shapes.l_prism, lambda: shapes.sphere(1)],
    ids=["box", "L", "s"],
)
@pytest.mark.parametrize("parts", [4, 100])
def test_fewer_parts_than_asked_for_come_with_a_note(make, parts):
    found = split_up(make(), parts=parts, samples=100)
    assert found.n_parts <= min(parts, len(found.labels))
    assert set(found.labels) == set(range(found.n_parts))
    if found.n_parts < parts:
        (note,) = found.notes
        assert f"{found.n_parts} of the {parts}" in note


def test_progress_rises_from_nothing_to_all():
    steps = decompose(shapes.l_shape(), Parameters(samples=100), BruteCaster)
    progress = list(steps)
    fractions = [p.fraction for p in progress]
    assert fractions == sorted(fractions)
    assert 0 <= fractions[0] < 0.1
    assert 0.8 < fractions[-1] <= 1
    assert all(p.stage for p in progress)


# Shapes that are hardly any, and such that are none.


def test_few_samples_and_many_eigenvectors():
    found = split_up(shapes.l_prism(), samples=16, eigenvectors=64, max_parts=13)
    assert 1 <= found.n_parts <= 8
    assert np.isfinite(found.psi)
    found = split_up(shapes.l_prism(), samples=16, parts=16, eigenvectors=0)
    assert 1 <= found.n_parts <= 8


@pytest.mark.parametrize(
    "make",
    [shapes.open_box, shapes.mobius, shapes.hollow_sphere],
    ids=lambda m: m.__name__,
)
@pytest.mark.parametrize("sight", ["ALL_PAIRS", "CONE"])
def test_odd_surfaces_have_parts(make, sight):
    found = split_up(make(), samples=60, sight=sight, psi_pairs="RAYS")
    assert found.n_parts >= 1
    assert np.isfinite(found.psi)
    assert np.isfinite(found.ranks).all()


def test_polygons_without_area_get_a_part_too():
    mesh = shapes.l_shape()
    flat = shapes.mesh_of(mesh.vertices[:3], [(0, 0, 1), (2, 2, 2)])
    found = split_up(shapes.joined(mesh, flat))
    assert len(found.labels) == 106
    assert found.n_parts == 2


@pytest.mark.parametrize(
    ("vertices", "triangles", "text"),
    [
        (np.eye(3), np.zeros((0, 3)), "no faces"),
        ([[0, 0, 0], [1, 0, 0], [0, np.nan, 0]], [[0, 1, 2]], "not finite"),
        ([[0, 0, 0], [1, 0, 0], [0, np.inf, 0]], [[0, 1, 2]], "not finite"),
        ([[0, 0, 0], [1, 1, 1], [2, 2, 2]], [[0, 1, 2]], "no area"),
        (np.ones((3, 3)), [[0, 1, 2]], "no area"),
        (np.eye(3), [[0, 1, 3]], "missing vertices"),
        (np.eye(3), [[0, 1, -1]], "missing vertices"),
    ],
    ids=["no faces", "nan", "inf", "degenerate", "coincident", "beyond", "below"],
)
def test_bad_input_is_refused_with_a_sentence(vertices, triangles, text):
    with pytest.raises(DecompositionError, match=text) as error:
        split_up(TriangleMesh(vertices, triangles, np.zeros(len(triangles))))
    assert str(error.value).endswith(".")
