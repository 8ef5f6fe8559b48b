import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.sight import likely_pairs as module
from weak_convex_decomposition.core.sight.likely_pairs import likely_pairs
from weak_convex_decomposition.core.sight.pair_visibility import PairVisibility
from weak_convex_decomposition.core.steps.progress import run


def likely(visible, positions):
    """Return the probabilities that pairs of samples lie in one part."""
    pairs = PairVisibility(np.asarray(visible, dtype=np.float32), None)
    return run(likely_pairs(pairs, np.asarray(positions, dtype=float))).visible


@pytest.fixture
def comb(seen):
    """Return the visibility of the comb: what its samples see is known."""
    return seen(shapes.comb).visibility


def test_they_are_probabilities_whose_sums_are_exact(comb):
    found = likely(comb.psi_pairs.visible, comb.samples.positions)
    assert found.dtype == np.float32
    assert found.min() >= 0
    assert found.max() == 1
    assert (found == found.T).all()
    assert (found.diagonal() == 1).all()
    assert (found * 256 == np.round(found * 256)).all()


def test_they_do_not_depend_on_the_steps_and_units(comb, monkeypatch):
    visible, positions = comb.psi_pairs.visible, comb.samples.positions
    whole = likely(visible, positions)
    monkeypatch.setattr(module, "_ENTRIES_PER_STEP", 1000)
    assert (likely(visible, positions) == whole).all()
    assert (likely(visible, 8.0 * positions) == whole).all()


def test_samples_that_see_the_same_are_likely_together():
    # 0 and 1 are hidden from each other, as on two sides of a bend, but both see 2 and
    # 3; 4 and 5 see nothing that 0 sees. All are equally far from each other.
    visible = np.eye(6)
    for one, other in ((0, 2), (0, 3), (1, 2), (1, 3), (2, 3), (4, 5)):
        visible[one, other] = visible[other, one] = 1
    found = likely(visible, np.eye(6))
    assert found[0, 1] > 2 * found[0, 4]
    assert found[2, 3] > found[0, 2] > found[0, 1]


def test_near_samples_are_likely_together():
    found = likely(np.ones((4, 4)), [(0, 0, 0), (1, 0, 0), (2, 0, 0), (9, 0, 0)])
    assert found[0, 1] > found[0, 2] > found[0, 3]


def test_parts_that_anyone_would_name_are_likely_ones(comb):
    # Little is likely from the first tooth to the last; within a tooth, much is.
    x = comb.samples.positions[:, 0]
    first, last = x < x.min() + 0.1 * np.ptp(x), x > x.max() - 0.1 * np.ptp(x)
    found = likely(comb.psi_pairs.visible, comb.samples.positions)
    assert found[np.ix_(first, last)].mean() < 0.15
    assert found[np.ix_(first, first)].mean() > 0.4


def fine():
    """Return a sphere of more than 600 triangles."""
    return shapes.sphere(3)


def test_they_count_in_meshes_whose_seams_run_anywhere(seen, comb):
    assert comb.likely_pairs is comb.psi_pairs
    visibility = seen(fine).visibility
    whole = likely(visibility.psi_pairs.visible, visibility.samples.positions)
    assert (visibility.likely_pairs.visible == whole).all()


def test_where_most_pairs_are_unknown_lines_of_sight_stay(seen):
    visibility = seen(fine, sight="ALL_PAIRS", rays=30).visibility
    assert visibility.psi_pairs.known is not None
    assert visibility.likely_pairs is visibility.psi_pairs
