"""From the embedding to clusters: the only place that uses scikit-learn."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray
from sklearn.cluster import KMeans

_STARTS = 4
_THREADS = "OMP_NUM_THREADS"
_DECIMALS = 6


def cluster(
    embedding: NDArray[np.float64], n_clusters: int, seed: int
) -> NDArray[np.int64]:
    """Return the k-means cluster of each row of `embedding`, (N,) int.

    Fewer than `n_clusters` where there are fewer distinct rows.
    """
    # Rows that differ by rounding alone would be clusters of noise.
    embedding = embedding.round(_DECIMALS)
    n_clusters = min(n_clusters, len(np.unique(embedding, axis=0)))
    model = KMeans(n_clusters=n_clusters, n_init=_STARTS, random_state=seed)
    with _no_count_of_cores():
        labels: NDArray[np.int64] = model.fit_predict(embedding).astype(np.int64)
    return labels


@contextmanager
def _no_count_of_cores() -> Iterator[None]:
    """Keep scikit-learn from starting a program that counts the physical cores."""
    before = os.environ.get(_THREADS)
    os.environ[_THREADS] = "1"
    try:
        yield
    finally:
        del os.environ[_THREADS]
        if before is not None:
            os.environ[_THREADS] = before
