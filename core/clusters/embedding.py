"""Spectral embedding of the samples, from the LoS matrix (section 4 of the paper)."""

from __future__ import annotations

from functools import partial

import numpy as np
from scipy.linalg import get_blas_funcs
from scipy.sparse.linalg import LinearOperator, eigsh

from ..sight.pair_visibility import Matrix
from ..steps.arrays import FloatArray

# Most samples whose matrix is in double precision; more would take too much memory.
# Libraries round sums differently. In double precision this changes the eigenvectors
# less. Otherwise k-means would find different clusters.
_MOST_IN_DOUBLE = 4_000
# Largest noise that is added to the diagonal of the matrix.
_NOISE = 1e-7
# Eigenvectors are computed in multiples of this: a default search needs 13.
_COORDINATES = 13
# Relative difference below which two entries of an eigenvector count as equally large.
_SAME = 1e-3


def embed(affinity: Matrix, n_coordinates: int, stochastic: bool) -> FloatArray:
    """Return coordinates in which samples of one weakly convex part are close.

    The coordinates are the leading eigenvectors of D^-1/2 M D^-1/2, where the diagonal
    matrix D holds the row sums of M. These are the trailing eigenvectors of the
    Laplacian I - D^-1/2 M D^-1/2. Each is scaled by its eigenvalue: eigenvectors of
    eigenvalue 0 are arbitrary and must not count. Shapes with few convex parts have
    many of them.

    Parameters
    ----------
    affinity : (N, N) float32 or sparse
        LoS matrix M (eq. 3): symmetric, not negative, with a positive diagonal.
    n_coordinates : int
        Number of eigenvectors. There are at most N − 1.
    stochastic : bool
        Use the eigenvectors of the random walk D^-1 M instead.

    Returns
    -------
    embedding : (N, n) float
        n ≤ `n_coordinates`. The sign of each column is fixed, so that runs agree.
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
    # The first of the largest entries: symmetric shapes have several of equal size.
    leading = (sizes >= (1 - _SAME) * sizes.max(axis=0)).argmax(axis=0)
    signs = np.sign(vectors[leading, np.arange(n_vectors)])
    return vectors * (signs * values * np.sqrt(n_samples))


def _shifted_walk(
    affinity: Matrix, scales: FloatArray, noise: FloatArray
) -> LinearOperator:
    """Return I + S M S + noise; S is diagonal with `scales`, the noise is diagonal too.

    Adding I keeps the tolerance of eigenvalues near 0 above 0. Where all samples are
    alike, the Krylov space ends early and ARPACK continues from its own random numbers.
    The noise prevents that, and it is the same every time.
    """
    times = affinity.__matmul__
    if isinstance(affinity, np.ndarray):
        # symv reads one half of a symmetric matrix: half as much memory to read.
        times = partial(get_blas_funcs("symv", (affinity,)), 1.0, affinity.T)

    def multiply(vector: FloatArray) -> FloatArray:
        vector = vector.ravel()
        product = times((scales * vector).astype(affinity.dtype))
        return scales * product + (1 + _NOISE * noise) * vector

    return LinearOperator(affinity.shape, multiply, dtype=np.float64)


def coordinates_for(n_parts: int) -> int:
    """Return the number of coordinates by which a number of parts is found.

    Eigenvectors depend slightly on how many are computed. Their number is always a
    multiple of 13, so that parts do not depend on the largest number tried.

    Parameters
    ----------
    n_parts : int
    """
    return _COORDINATES * -(-n_parts // _COORDINATES)
