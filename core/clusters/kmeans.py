"""k-means clusters of the embedding: the only module that uses scikit-learn."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray
from sklearn.cluster import KMeans

# Random starts of k-means; the best result is kept.
_STARTS = 4
# Environment variable with the number of threads.
_THREADS = "OMP_NUM_THREADS"
# Decimals that the embedding is rounded to.
_DECIMALS = 6


def cluster(
    embedding: NDArray[np.float64], n_clusters: int, seed: int
) -> NDArray[np.int64]:
    """Return the k-means cluster of each sample.

    Parameters
    ----------
    embedding : (N, n) float
        Coordinates of the samples.
    n_clusters : int
        Number of clusters. If there are fewer distinct rows, there are as many clusters
        as distinct rows.
    seed : int
        Seed of the random starts.

    Returns
    -------
    labels : (N,) int
        Cluster of each row of `embedding`, from 0.
    """
    # Otherwise rows that differ only by rounding could become separate clusters.
    embedding = embedding.round(_DECIMALS)
    if len(np.unique(embedding[:, -1])) < n_clusters:  # a quick look at one column
        n_clusters = min(n_clusters, len(np.unique(embedding, axis=0)))
    starts = iter(_far_apart(embedding, n_clusters, seed))
    model = KMeans(
        n_clusters,
        init=lambda points, n_clusters, random_state: points[next(starts)],
        n_init=_STARTS,
        random_state=seed,
    )
    with _no_count_of_cores():
        labels: NDArray[np.int64] = model.fit_predict(embedding).astype(np.int64)
    return labels


def _far_apart(
    points: NDArray[np.float64], n_chosen: int, seed: int
) -> NDArray[np.int64]:
    """Choose points that are far apart, for each start: greedy k-means++.

    Arthur and Vassilvitskii 2007. scikit-learn does this too, but one start after the
    other, which takes half of the time of k-means.

    Returns
    -------
    rows : (S, K) int
    """
    rng, starts = np.random.default_rng(seed), np.arange(_STARTS)
    n_tried, columns = 2 + int(np.log(n_chosen)), points.T.copy()
    norms = np.einsum("nd,nd->n", points, points)

    def squares(rows: NDArray[np.int64]) -> NDArray[np.float64]:
        found = -2 * (points[rows.ravel()] @ columns)
        found += norms
        found += norms[rows.ravel(), None]
        return np.maximum(found, 0.0, out=found).reshape(*rows.shape, -1)

    chosen = [rng.integers(len(points), size=_STARTS)]
    nearest = squares(chosen[0])  # squared distance to the nearest chosen point
    while len(chosen) < n_chosen:
        sums = nearest.cumsum(axis=1)
        drawn = rng.random((_STARTS, n_tried)) * sums[:, -1:]
        tried = np.stack(list(map(np.searchsorted, sums[:, :-1], drawn)))
        left = np.minimum(nearest[:, None], squares(tried))
        best = left.sum(axis=2).argmin(axis=1)
        nearest = left[starts, best]
        chosen.append(tried[starts, best])
    return np.stack(chosen, axis=1)


@contextmanager
def _no_count_of_cores() -> Iterator[None]:
    """Set OMP_NUM_THREADS, or scikit-learn runs a program that counts the cores."""
    before = os.environ.get(_THREADS)
    os.environ[_THREADS] = "1"
    try:
        yield
    finally:
        del os.environ[_THREADS]
        if before is not None:
            os.environ[_THREADS] = before
