import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from weak_convex_decomposition.core.clusters.kmeans import cluster


def clouds(n_clouds, n_points=20):
    rng = np.random.default_rng(0)
    centers = 10 * rng.normal(size=(n_clouds, 3))
    numbers = np.repeat(np.arange(n_clouds), n_points)
    return centers[numbers] + 0.01 * rng.normal(size=(len(numbers), 3)), numbers


@pytest.mark.parametrize("n_clouds", [1, 2, 5])
def test_separate_clouds_are_found(n_clouds):
    points, numbers = clouds(n_clouds)
    labels = cluster(points, n_clouds, 0)
    assert labels.dtype == np.int64
    assert sorted(set(labels)) == list(range(n_clouds))
    pairs = set(zip(labels, numbers, strict=True))
    assert len(pairs) == n_clouds


def test_the_seed_decides():
    points = np.random.default_rng(1).normal(size=(200, 4))
    assert (cluster(points, 6, 3) == cluster(points, 6, 3)).all()
    partitions = [
        {frozenset(np.flatnonzero(labels == k).tolist()) for k in range(6)}
        for labels in (cluster(points, 6, seed) for seed in (3, 4))
    ]
    assert partitions[0] != partitions[1]


def test_fewer_places_than_clusters_pass_without_a_warning():
    """A convex shape puts all its samples in one place."""
    labels = cluster(np.ones((20, 3)), 4, 0)
    assert len(labels) == 20
    assert labels.min() >= 0
    assert labels.max() < 4


@pytest.mark.parametrize("before", [None, "3"])
def test_several_threads_leave_the_environment_as_it_was(monkeypatch, before):
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    if before:
        monkeypatch.setenv("OMP_NUM_THREADS", before)
    points, _ = clouds(5, 200)
    with ThreadPoolExecutor(4) as pool:
        labels = list(pool.map(lambda _: cluster(points, 8, 0), range(20)))
    assert all((each == labels[0]).all() for each in labels)
    assert os.environ.get("OMP_NUM_THREADS") == before
