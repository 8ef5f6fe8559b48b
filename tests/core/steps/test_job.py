import pytest
from weak_convex_decomposition.core.steps.job import Job
from weak_convex_decomposition.core.steps.progress import Progress, run, within


class Clock:
    """Seconds that pass only when a step takes them."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


def working(clock, n_steps, seconds, log):
    try:
        for step in range(n_steps):
            clock.now += seconds
            log.append(step)
            yield Progress(f"Step {step}", step / n_steps)
    finally:
        log.append("cleaned up")
    return "value"


def test_a_slice_lasts_as_long_as_its_budget():
    clock, log = Clock(), []
    job = Job(working(clock, 10, 1.0, log), clock)
    assert not job.advance(2.5)
    assert log == [0, 1, 2]
    assert job.progress == Progress("Step 2", 0.2)
    assert not job.advance(0.0)
    assert log == [0, 1, 2, 3]


def test_the_last_slice_ends_early_with_the_value():
    clock, log = Clock(), []
    job = Job(working(clock, 3, 1.0, log), clock)
    assert job.advance(1e9)
    assert job.done
    assert job.result() == "value"
    assert clock.now == 3.0
    assert job.advance(1.0)
    assert job.result() == "value"


def test_the_rest_goes_on_where_slices_ended_and_has_the_value():
    clock, log = Clock(), []
    job = Job(working(clock, 4, 1.0, log), clock)
    job.advance(0.0)
    steps = job.rest()
    assert next(steps) == Progress("Step 1", 0.25)
    job.advance(0.0)  # in between, somebody else works on it too
    assert run(steps) == "value"
    assert log == [0, 1, 2, 3, "cleaned up"]
    assert run(job.rest()) == "value"


def test_a_job_that_is_not_done_has_no_result():
    clock = Clock()
    job = Job(working(clock, 3, 1.0, []), clock)
    assert job.progress.fraction == 0.0
    with pytest.raises(RuntimeError):
        job.result()


def test_cancel_runs_the_finally_clauses_of_all_stages():
    clock, log = Clock(), []

    def outer():
        try:
            yield from within(working(clock, 5, 1.0, log), 0.0, 0.5)
        finally:
            log.append("outer")

    job = Job(outer(), clock)
    job.advance(1.5)
    job.cancel()
    assert log == [0, 1, "cleaned up", "outer"]
    assert not job.done


def test_cancel_before_the_start_and_after_the_end_does_nothing():
    clock, log = Clock(), []
    job = Job(working(clock, 2, 1.0, log), clock)
    job.cancel()
    assert log == []
    job = Job(working(clock, 2, 1.0, log), clock)
    job.advance(9.0)
    job.cancel()
    assert job.result() == "value"


def test_an_error_comes_out_of_the_slice_it_happens_in():
    def failing():
        yield Progress("Fine", 0.0)
        raise ValueError("no")

    job = Job(failing(), Clock())
    with pytest.raises(ValueError, match="no"):
        job.advance(1.0)
    assert not job.done
