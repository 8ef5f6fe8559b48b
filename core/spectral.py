"""From the LoS matrix to the embedding of the samples (section 4 of the paper)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, eigsh

from .convexity import Matrix

_NOISE = 1e-7
_SAME = 1e-3


def embed(
    affinity: Matrix,
    n_coordinates: int,
    regularization: float,
    stochastic: bool,
) -> NDArray[np.float64]:
    """Return coordinates in which samples of one weakly convex part are near.

    The affinity M gets `regularization` times its mean degree spread over each row,
    A = M + tau d / N, which keeps nearly isolated samples from standing out as parts
    of their own and joins what is disconnected. The leading eigenvectors of
    D^-1/2 A D^-1/2 (the trailing ones of the Laplacian I - D^-1/2 A D^-1/2), each
    times its eigenvalue, are coordinates whose distances are those of a diffusion
    along the lines of sight.

    Parameters
    ----------
    affinity : (N, N) float32 or sparse
        Symmetric, not negative, with a positive diagonal.
    n_coordinates : int
        Number of eigenvectors; fewer where N is too small.
    regularization : float
        tau.
    stochastic : bool
        Take the eigenvectors of the random walk D^-1 A instead.

    Returns
    -------
    embedding : (N, n) float
        n ≤ `n_coordinates`. Signs are chosen so that runs agree.
    """
    n_samples = affinity.shape[0]
    degrees = np.asarray(affinity.sum(axis=1), dtype=np.float64).ravel()
    spread = regularization * degrees.mean() / n_samples
    scales = 1.0 / np.sqrt(degrees + spread * n_samples)
    rng = np.random.default_rng(0)
    n_vectors = min(n_coordinates, n_samples - 1)
    values, vectors = eigsh(
        _shifted_walk(affinity, spread, scales, rng.random((n_samples,))),
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
    spread: float,
    scales: NDArray[np.float64],
    noise: NDArray[np.float64],
) -> LinearOperator:
    """Return I + S (M + spread) S, S the diagonal of `scales`, and some noise on it.

    Shifted by I, so that the tolerance of eigenvalues near 0 is not 0. Where samples
    are all alike, a Krylov space ends early and ARPACK goes on from random numbers of
    its own; the noise keeps it going, the same every time.
    """

    def multiply(vector: NDArray[np.float64]) -> NDArray[np.float64]:
        vector = vector.ravel()
        scaled = scales * vector
        product = affinity @ scaled.astype(affinity.dtype)
        return (
            scales * (product + spread * scaled.sum()) + (1 + _NOISE * noise) * vector
        )

    return LinearOperator(affinity.shape, multiply, dtype=np.float64)
