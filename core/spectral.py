"""From the LoS matrix to the embedding of the samples (section 4 of the paper)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, eigsh

from .convexity import Matrix


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

    def multiply(vector: NDArray[np.float64]) -> NDArray[np.float64]:
        scaled = scales * vector.ravel()
        product = affinity @ scaled.astype(affinity.dtype)
        return scales * (product + spread * scaled.sum())

    n_vectors = min(n_coordinates, n_samples - 1)
    values, vectors = eigsh(
        LinearOperator((n_samples, n_samples), multiply, dtype=np.float64),
        k=n_vectors,
        which="LA",
        v0=np.sqrt(degrees),
        tol=1e-6,
    )
    order = np.argsort(-values)
    values, vectors = values[order], vectors[:, order]
    if stochastic:
        vectors = vectors * scales[:, None] * np.sqrt(degrees.mean())
    signs = np.sign(vectors[np.abs(vectors).argmax(axis=0), np.arange(n_vectors)])
    embedding: NDArray[np.float64] = vectors * (signs * values * np.sqrt(n_samples))
    return embedding
