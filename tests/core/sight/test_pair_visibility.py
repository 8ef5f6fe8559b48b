import changes
import numpy as np
import pytest
import shapes
from computed import measure
from definitions import psi, tables
from scipy import sparse
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.sight.pair_visibility import PairVisibility

ALPHAS = (0.0, 0.5, 1.0, 3.0)
UNIFORM_CONES = {"sight": "CONE", "psi_pairs": "UNIFORM"}


def rank_of(mesh, **values):
    return measure(mesh, Parameters(**{"samples": 200, **values}))


def two_spheres(ratio):
    return shapes.joined(
        shapes.sphere(0), shapes.sphere(0, np.sqrt(ratio), center=(4, 0, 0))
    )


def shares(ratio):
    first = 1 / (1 + ratio)
    return first**2 + (1 - first) ** 2


@pytest.mark.parametrize("values", [{}, UNIFORM_CONES], ids=["all", "uniform"])
@pytest.mark.parametrize(
    ("make", "expected"),
    [
        (shapes.box, 1.0),
        (lambda: shapes.sphere(0), 1.0),
        (lambda: two_spheres(1.0), 0.5),
        (lambda: two_spheres(4.0), shares(4.0)),
    ],
    ids=["box", "sphere", "equal", "four"],
)
def test_ranks_of_convex_shapes_and_of_several(make, expected, values):
    measurement = rank_of(make(), **values)
    # Stratified samples may have no spread left: a sample's share may still err.
    error = max(4 * measurement.standard_error, 2 / 200)
    if expected == 1.0:
        assert measurement.rank == 1.0
        assert measurement.standard_error == 0.0
    assert measurement.rank == pytest.approx(expected, abs=error)
    assert measurement.n_samples == 200


def test_rank_of_a_hollow_sphere():
    q = 0.5
    outer, inner = 1 / (1 + q**2), q**2 / (1 + q**2)
    expected = outer**2 * (1 - q**2) + outer * inner * (1 - q)
    measurement = rank_of(shapes.hollow_sphere(q), samples=150)
    # Facets of the inner sphere, and each sample with itself, add a little.
    assert measurement.rank == pytest.approx(
        expected, abs=4 * measurement.standard_error + 0.01
    )
    assert 0.001 < measurement.standard_error < 0.05


def test_the_standard_error_is_honest():
    mesh = shapes.l_prism()
    measurements = [rank_of(mesh, samples=100, seed=seed) for seed in range(20)]
    spread = np.std([m.rank for m in measurements], ddof=1)
    claimed = np.mean([m.standard_error for m in measurements])
    assert spread / 3 < claimed < spread * 3


def test_a_measurement_says_what_was_turned():
    inside_out = rank_of(changes.inside_out(shapes.l_prism()))
    assert inside_out.notes
    assert inside_out.rank == pytest.approx(rank_of(shapes.l_prism()).rank, abs=0.05)


# The figures from pairs, against their definitions.


@pytest.fixture(params=["dense", "sparse", "partial"])
def pairs(request):
    rng = np.random.default_rng(7)
    los = rng.random((30, 30)) < 0.4
    los = (los | los.T | np.eye(30, dtype=bool)).astype(np.float32)
    if request.param == "dense":
        return PairVisibility(los, None)
    known = np.ones((30, 30), dtype=np.float32)
    if request.param == "partial":
        half = np.triu(rng.integers(3, size=(30, 30)))
        known = (half + half.T).astype(np.float32)
    return PairVisibility(sparse.csr_array(los * known), sparse.csr_array(known))


LABELS = np.random.default_rng(8).integers(4, size=30)


@pytest.mark.parametrize("alpha", ALPHAS)
def test_psi_is_equation_5(pairs, alpha):
    tally = pairs.tally(LABELS, 4)
    assert tally.psi(alpha) == pytest.approx(psi(pairs, LABELS, alpha))


def test_psi_of_one_part_is_the_rank_of_all(pairs):
    whole = pairs.tally(np.zeros(30, dtype=int), 1)
    assert whole.psi(1.0) == pytest.approx(pairs.rank_of_all()[0])
    assert whole.ranks() == pytest.approx([pairs.rank_of_all()[0]])


def test_ranks_are_equation_1(pairs):
    visible, known = tables(pairs)
    ranks = pairs.tally(LABELS, 4).ranks()
    for label in range(4):
        members = np.ix_(label == LABELS, label == LABELS)
        expected = visible[members].sum() / known[members].sum()
        assert ranks[label] == pytest.approx(expected)


def test_a_part_without_samples_has_rank_one(pairs):
    assert pairs.tally(LABELS, 5).ranks()[4] == 1.0


@pytest.mark.parametrize("alpha", ALPHAS)
def test_merge_gains_are_what_psi_gains(pairs, alpha):
    tally = pairs.tally(LABELS, 4)
    gains = tally.merge_gains(alpha)
    for one in range(4):
        assert gains[one, one] == -np.inf
        for other in range(4):
            if one == other:
                continue
            merged = np.where(other == LABELS, one, LABELS)
            gain = psi(pairs, merged, alpha) - psi(pairs, LABELS, alpha)
            assert gains[one, other] == pytest.approx(gain, abs=1e-9)


def test_a_merged_tally_counts_what_the_merged_labels_count(pairs):
    merged = np.array([0, 1, 1, 2])[LABELS]
    expected = pairs.tally(merged, 3)
    found = pairs.tally(LABELS, 4).merged(1, 2)
    assert found.visible == pytest.approx(expected.visible)
    assert found.known == pytest.approx(expected.known)
