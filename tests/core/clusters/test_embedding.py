import numpy as np
import pytest
from scipy import sparse
from weak_convex_decomposition.core.clusters.embedding import embed


def random_affinity(n_samples=40, density=0.2, seed=0):
    half = np.random.default_rng(seed).random((n_samples, n_samples)) < density
    return (half | half.T | np.eye(n_samples, dtype=bool)).astype(np.float32)


def blocks(*sizes):
    numbers = np.repeat(np.arange(len(sizes)), sizes)
    return (numbers[:, None] == numbers).astype(np.float32), numbers


@pytest.mark.parametrize("stochastic", [False, True])
def test_columns_are_eigenvectors_of_the_normalized_affinity(stochastic):
    affinity = random_affinity()
    degrees = affinity.sum(axis=1)
    if stochastic:
        matrix = affinity / degrees[:, None]
    else:
        matrix = affinity / np.sqrt(np.outer(degrees, degrees))
    embedding = embed(affinity, 5, stochastic)
    largest = np.sort(np.linalg.eigvals(matrix).real)[::-1][:5]
    for column, value in zip(embedding.T, largest, strict=True):
        assert matrix @ column == pytest.approx(value * column, abs=1e-3)
    assert np.linalg.norm(embedding, axis=0).min() > 0.1


def test_each_column_is_as_long_as_its_eigenvalue():
    affinity = random_affinity()
    degrees = affinity.sum(axis=1)
    matrix = affinity / np.sqrt(np.outer(degrees, degrees))
    largest = np.linalg.eigvalsh(matrix)[::-1][:6]
    lengths = np.linalg.norm(embed(affinity, 6, False), axis=0)
    assert lengths / lengths[0] == pytest.approx(np.abs(largest) / largest[0], rel=1e-3)


def test_stochastic_rows_are_laplacian_rows_over_the_root_of_the_degree():
    affinity = random_affinity()
    degrees = affinity.sum(axis=1)
    laplacian, stochastic = (embed(affinity, 4, s) for s in (False, True))
    ratio = stochastic * np.sqrt(degrees)[:, None] / laplacian
    sizes = np.abs(ratio[np.abs(laplacian) > 1e-2])
    assert sizes == pytest.approx(np.full(len(sizes), sizes.mean()), rel=1e-2)


@pytest.mark.parametrize("sizes", [(20, 20), (30, 15, 8), (20, 20, 1, 1)])
@pytest.mark.parametrize("stochastic", [False, True])
def test_samples_that_see_the_same_lie_in_one_place(sizes, stochastic):
    affinity, numbers = blocks(*sizes)
    embedding = embed(affinity, len(sizes), stochastic)
    assert np.isfinite(embedding).all()
    for number in range(len(sizes)):
        rows = embedding[numbers == number]
        assert rows == pytest.approx(np.tile(rows[0], (len(rows), 1)), abs=1e-3)


def test_separate_blocks_lie_apart():
    affinity, numbers = blocks(30, 15, 8)
    embedding = embed(affinity, 3, False)
    centers = np.stack([embedding[numbers == n].mean(axis=0) for n in range(3)])
    distances = np.linalg.norm(centers[:, None] - centers, axis=2)
    assert distances[np.triu_indices(3, 1)].min() > 0.1


@pytest.mark.parametrize("kind", [np.asarray, sparse.csr_array])
def test_isolated_samples_make_no_gaps(kind):
    affinity = kind(np.eye(20, dtype=np.float32))
    embedding = embed(affinity, 6, False)
    assert embedding.shape == (20, 6)
    assert np.isfinite(embedding).all()


def test_more_eigenvectors_than_samples_are_as_many_as_can_be():
    embedding = embed(random_affinity(16), 64, False)
    assert embedding.shape == (16, 15)
    assert np.isfinite(embedding).all()


def test_sparse_and_dense_agree():
    affinity = random_affinity()
    dense = embed(affinity, 5, False)
    assert embed(sparse.csr_array(affinity), 5, False) == pytest.approx(dense, abs=1e-3)


def test_shuffled_samples_are_where_they_were():
    affinity = random_affinity()
    order = np.random.default_rng(1).permutation(len(affinity))
    embedding = embed(affinity, 5, False)
    shuffled = embed(affinity[np.ix_(order, order)], 5, False)
    expected = embedding[order]
    assert shuffled @ shuffled.T == pytest.approx(expected @ expected.T, abs=1e-2)


@pytest.mark.parametrize(
    "affinity",
    [
        random_affinity(),
        np.ones((40, 40), dtype=np.float32),
        blocks(20, 20)[0],
        blocks(30, 15, 8)[0],
        np.eye(40, dtype=np.float32),
    ],
    ids=["random", "convex", "two", "three", "isolated"],
)
def test_the_same_matrix_has_the_same_embedding(affinity):
    """Also where eigenvalues repeat, and whatever was embedded in between."""
    first = embed(affinity, 6, False)
    embed(random_affinity(seed=5), 6, False)
    assert embed(affinity, 6, False) == pytest.approx(first, abs=1e-6)
