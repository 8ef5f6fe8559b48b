"""k-means clusters of the embedding: the only module that uses scikit-learn."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock

import numpy as np
from sklearn.cluster import KMeans

from ..steps.arrays import FloatArray, IntArray

# Random starts of k-means; the best result is kept.
_STARTS = 3
# Environment variable with the number of threads.
_THREADS = "OMP_NUM_THREADS"
# One thread at a time sets it, and brings it back: it is the whole process's.
_SETTING = Lock()
# Decimals that the embedding is rounded to.
_DECIMALS = 6


def cluster(embedding: FloatArray, n_clusters: int, seed: int) -> IntArray:
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
    model = KMeans(n_clusters, n_init=_STARTS, random_state=seed)
    with _no_count_of_cores():
        labels: IntArray = model.fit_predict(embedding).astype(np.int64)
    return labels


@contextmanager
def _no_count_of_cores() -> Iterator[None]:
    """Set OMP_NUM_THREADS, or scikit-learn runs a program that counts the cores."""
    with _SETTING:
        before = os.environ.get(_THREADS)
        os.environ[_THREADS] = "1"
        try:
            yield
        finally:
            os.environ.pop(_THREADS, None)
            if before is not None:
                os.environ[_THREADS] = before
