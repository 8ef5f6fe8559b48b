import numpy as np
import pytest
import shapes
from definitions import psi
from scipy import sparse
from weak_convex_decomposition.core.clusters import moves
from weak_convex_decomposition.core.clusters.moves import MoveGains, raise_psi
from weak_convex_decomposition.core.sight.pair_visibility import PairVisibility

ALPHAS = (0.5, 1.0, 2.0)


def random_pairs(seed, n_samples=90, share=1.0):
    """Return pairs of which each is known with a probability, half of them visible."""
    rng = np.random.default_rng(seed)
    known = np.triu(rng.random((n_samples, n_samples)) < share, 1)
    visible = known & (rng.random(known.shape) < 0.5)
    known, visible = (half + half.T + np.eye(n_samples) for half in (known, visible))
    if share == 1.0:
        return PairVisibility(visible.astype(np.float32), None)
    return PairVisibility(
        *(sparse.csr_array(matrix.astype(np.float32)) for matrix in (visible, known))
    )


@pytest.mark.parametrize("alpha", ALPHAS)
def test_blocks_that_see_each_other_are_found(alpha):
    truth = np.repeat(np.arange(3), 40)
    pairs = PairVisibility((truth[:, None] == truth).astype(np.float32), None)
    start = truth.copy()
    start[::7] = 0
    labels = raise_psi(pairs, start, 3, alpha)
    assert (labels == truth).all()
    assert (start[::7] == 0).all()


def assert_no_single_move_gains(pairs, labels, alpha):
    """Try every other label for every sample."""
    reached = psi(pairs, labels, alpha)
    for sample in range(len(labels)):
        for label in set(range(4)) - {labels[sample]}:
            moved = labels.copy()
            moved[sample] = label
            gain = psi(pairs, moved, alpha) - reached
            assert gain < 1e-9, f"sample {sample} gains {gain} in {label}"


@pytest.mark.parametrize("share", [1.0, 0.5])
@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize("seed", range(3))
def test_psi_rises_until_no_single_move_raises_it(seed, alpha, share, monkeypatch):
    pairs = random_pairs(seed, share=share)
    start = np.random.default_rng(seed).integers(4, size=90)
    before = psi(pairs, start, alpha)
    assert psi(pairs, raise_psi(pairs, start, 4, alpha), alpha) > before
    # One sample a turn: samples of one turn may undo each other's gain for ever, as
    # none of these lies far from another.
    monkeypatch.setattr(moves, "_TURNS", 90)
    labels = raise_psi(pairs, start, 4, alpha)
    assert psi(pairs, labels, alpha) > before
    assert_no_single_move_gains(pairs, labels, alpha)


@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize("make", [shapes.comb, shapes.dumbbell, shapes.table])
def test_no_single_move_raises_psi_of_a_shape(seen, make, alpha):
    pairs = seen(make).visibility.psi_pairs
    start = np.random.default_rng(0).integers(4, size=150)
    assert_no_single_move_gains(pairs, raise_psi(pairs, start, 4, alpha), alpha)


def test_samples_that_all_see_each_other_become_one():
    pairs = PairVisibility(np.ones((60, 60), dtype=np.float32), None)
    labels = raise_psi(pairs, np.arange(60) % 4, 4, 1.0)
    assert len(set(labels)) == 1


@pytest.mark.parametrize("share", [1.0, 0.5])
@pytest.mark.parametrize("alpha", ALPHAS)
def test_gains_tell_what_a_move_gains(alpha, share):
    pairs = random_pairs(5, share=share)
    labels = np.random.default_rng(5).integers(4, size=90)
    gains = MoveGains(pairs, labels, 4).of(slice(None), alpha)
    for sample in (0, 17, 89):
        for label in range(4):
            moved = labels.copy()
            moved[sample] = label
            gain = psi(pairs, moved, alpha) - psi(pairs, labels, alpha)
            told = (gains[sample, label] - gains[sample, labels[sample]]) / 90
            assert gain == pytest.approx(told, abs=1e-9)
    rows = slice(3, None, 30)
    assert (MoveGains(pairs, labels, 4).of(rows, alpha) == gains[rows]).all()


@pytest.mark.parametrize("share", [1.0, 0.5])
def test_gains_follow_the_labels(share):
    pairs = random_pairs(6, share=share)
    before, after = np.random.default_rng(6).integers(4, size=(2, 90))
    gains = MoveGains(pairs, before, 4)
    changed = np.flatnonzero(before != after)
    for samples in (changed[::2], changed[1::2]):
        gains.give(samples, after[samples])
    anew = MoveGains(pairs, after, 4)
    assert (gains.of(slice(None), 2.0) == anew.of(slice(None), 2.0)).all()


@pytest.mark.parametrize("share", [1.0, 0.5])
def test_hidden_pairs_can_be_revealed(share):
    pairs = random_pairs(2, share=share)
    first, second = pairs.hidden()
    assert (first < second).all()
    revealed = pairs.revealed(first[:10], second[:10])
    rest = revealed.hidden()
    assert [*zip(*rest, strict=True)] == [*zip(first[10:], second[10:], strict=True)]
    assert (revealed.visible != revealed.visible.T).sum() == 0
    assert len(pairs.hidden()[0]) == len(first)
