"""Products of matrices stay on one thread, and only while steps are at work."""

from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from time import sleep

import numpy as np
import pytest
from scipy.linalg import blas  # noqa: F401  # loads what is limited
from shapes import dumbbell
from threadpoolctl import ThreadpoolController, threadpool_limits
from weak_convex_decomposition.core.clouds import normals
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts import part_memo
from weak_convex_decomposition.core.pictures import draw_picture
from weak_convex_decomposition.core.steps import one_thread
from weak_convex_decomposition.core.steps.one_thread import on_one_thread
from weak_convex_decomposition.core.steps.progress import Progress, run


def threads():
    """Return the largest number of threads that a library would use."""
    return max(each["num_threads"] for each in ThreadpoolController().info())


@pytest.fixture(autouse=True)
def two_threads():
    np.ones((2, 2)) @ np.ones((2, 2))
    with threadpool_limits(limits=2):
        assert threads() == 2
        yield


def counting():
    yield Progress("First", threads() / 10)
    yield Progress("Second", threads() / 10)
    return threads()


def test_steps_work_on_one_thread_and_others_between_them_on_more():
    steps = on_one_thread(counting)()
    for _ in range(2):
        assert next(steps).fraction == 0.1
        assert threads() == 2
    assert run(steps) == 1
    assert threads() == 2


def test_normals_are_estimated_on_one_thread(monkeypatch):
    found = []

    def noise_of(points):
        found.append(threads())
        return 0.02

    monkeypatch.setattr(normals, "noise_of", noise_of)
    run(normals.estimate_normals(np.random.default_rng(0).normal(size=(100, 3))))
    assert found == [1]
    assert threads() == 2


def test_pictures_are_drawn_on_one_thread(seen, monkeypatch):
    found = []

    def embed(affinity, n_coordinates, stochastic):
        found.append(threads())
        return np.random.default_rng(0).normal(size=(affinity.shape[0], n_coordinates))

    monkeypatch.setattr(part_memo, "embed", embed)
    mesh, parameters = dumbbell(), Parameters()
    memo = part_memo.PartMemo(seen(dumbbell).visibility)  # without an embedding
    labels = np.arange(mesh.n_polygons) % 2
    draw_picture("SCATTER", memo, labels, parameters, np.eye(3)[:2])
    assert found == [1]
    assert threads() == 2


def test_errors_and_cancelling_give_the_threads_back():
    closed = []

    def failing():
        try:
            yield Progress("First", 0.0)
            raise ValueError("broken")
        finally:
            closed.append(threads())

    with pytest.raises(ValueError, match="broken"):
        run(on_one_thread(failing)())
    cancelled = on_one_thread(failing)()
    next(cancelled)
    cancelled.close()
    assert len(closed) == 2
    assert threads() == 2


class Pool:
    """A pool of threads that every thread can limit, as most are."""

    size = 2

    @contextmanager
    def limit(self, limits):
        before, self.size = self.size, limits
        yield
        self.size = before


@pytest.fixture
def pool(monkeypatch):
    found = Pool()
    monkeypatch.setattr(one_thread, "_controller", lambda _: found)
    return found


def test_several_threads_are_limited_and_give_the_threads_back(pool):
    found = []

    def slow(duration):
        sleep(duration)
        found.append(pool.size)
        yield Progress("Slow", 0.0)

    with ThreadPoolExecutor(4) as workers:
        durations = 0.01, 0.02, 0.03, 0.04
        list(workers.map(lambda each: run(on_one_thread(slow)(each)), durations))
    assert found == [1] * 4
    assert pool.size == 2


def test_steps_that_are_never_resumed_let_other_threads_work(pool):
    def looking():
        yield Progress("First", 0.0)
        return pool.size

    suspended = on_one_thread(looking)()
    next(suspended)
    with ThreadPoolExecutor(1) as worker:
        assert worker.submit(run, on_one_thread(looking)()).result(timeout=30) == 1
