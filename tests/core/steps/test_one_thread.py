"""Products of matrices stay on one thread, and only while steps are at work."""

import numpy as np
import pytest
from scipy.linalg import blas  # noqa: F401  # loads what is limited
from threadpoolctl import ThreadpoolController, threadpool_limits
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
