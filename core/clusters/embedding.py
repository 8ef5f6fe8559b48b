"""From the LoS matrix to the embedding of the samples (section 4 of the paper)."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import get_blas_funcs
from scipy.sparse.linalg import LinearOperator, eigsh

from ..sight.pairs import Matrix

# In double precision eigenvectors depend less on how sums are rounded, which libraries
# differ in: k-means would make other clusters of them. More samples take too much
# memory.
_MOST_IN_DOUBLE = 4_000
_NOISE = 1e-7
_SAME = 1e-3


def embed(
    affinity: Matrix, n_coordinates: int, stochastic: bool
) -> NDArray[np.float64]:
    """Return coordinates in which samples of one weakly convex part are near.

    The coordinates are the leading eigenvectors of D^-1/2 M D^-1/2, D the diagonal of
    the row sums of M: the trailing ones of the Laplacian I - D^-1/2 M D^-1/2. Each is
    as long as its eigenvalue: those of eigenvalue 0, which shapes of few convex parts
    have many of, are arbitrary and must not count.

    Parameters
    ----------
    affinity : (N, N) float32 or sparse
        M: symmetric, not negative, with a positive diagonal.
    n_coordinates : int
        Number of eigenvectors; fewer where N is too small.
    stochastic : bool
        Take the eigenvectors of the random walk D^-1 M instead.

    Returns
    -------
    embedding : (N, n) float
        n ≤ `n_coordinates`. Signs are chosen so that runs agree.
    """
    n_samples = affinity.shape[0]
    if n_samples <= _MOST_IN_DOUBLE:
        affinity = affinity.astype(np.float64)
    degrees = np.asarray(affinity.sum(axis=1), dtype=np.float64).ravel()
    scales = 1.0 / np.sqrt(degrees)
    rng = np.random.default_rng(0)
    n_vectors = min(n_coordinates, n_samples - 1)
    values, vectors = eigsh(
        _shifted_walk(affinity, scales, rng.random((n_samples,))),
        k=n_vectors,
        which="LA",
        v0=rng.random(n_samples),
        tol=1e-6,
    )
    order = np.argsort(-values)
    values, vectors = values[order] - 1, vectors[:, order]
    if stochastic:
        vectors = vectors * scales[:, None] * np.sqrt(degrees.mean())
    sizes = np.abs(vectors)
    # The first of the largest entries, which symmetric shapes have several of.
    leading = (sizes >= (1 - _SAME) * sizes.max(axis=0)).argmax(axis=0)
    signs = np.sign(vectors[leading, np.arange(n_vectors)])
    embedding: NDArray[np.float64] = vectors * (signs * values * np.sqrt(n_samples))
    return embedding


def _shifted_walk(
    affinity: Matrix,
    scales: NDArray[np.float64],
    noise: NDArray[np.float64],
) -> LinearOperator:
    """Return I + S M S, S the diagonal of `scales`, and some noise on it.

    Shifted by I, so that the tolerance of eigenvalues near 0 is not 0. Where samples
    are all alike, a Krylov space ends early and ARPACK goes on from random numbers of
    its own; the noise keeps it going, the same every time.
    """
    times = affinity.__matmul__
    if isinstance(affinity, np.ndarray):
        # Half of a symmetric matrix says it all: half as much to read.
        times = partial(get_blas_funcs("symv", (affinity,)), 1.0, affinity.T)

    def multiply(vector: NDArray[np.float64]) -> NDArray[np.float64]:
        vector = vector.ravel()
        product = times((scales * vector).astype(affinity.dtype))
        return scales * product + (1 + _NOISE * noise) * vector

    return LinearOperator(affinity.shape, multiply, dtype=np.float64)
