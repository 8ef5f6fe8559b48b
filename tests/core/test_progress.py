import pytest
from weak_convex_decomposition.core.progress import Progress, run, within


def counting(n_steps, log=None):
    try:
        for step in range(n_steps):
            yield Progress("Counting", step / n_steps)
    finally:
        if log is not None:
            log.append("closed")
    return n_steps


def test_run_returns_the_value_of_the_steps():
    assert run(counting(5)) == 5
    assert run(counting(0)) == 0


def test_run_lets_errors_through():
    def failing():
        yield Progress("Failing", 0.0)
        raise ValueError("no")

    with pytest.raises(ValueError, match="no"):
        run(failing())


def test_within_shrinks_fractions_and_keeps_stage_and_value():
    def outer():
        return (yield from within(within(counting(4), 0.0, 0.5), 0.5, 0.9))

    assert run(outer()) == 4
    seen = list(outer())
    assert [progress.stage for progress in seen] == ["Counting"] * 4
    expected = [0.5, 0.55, 0.6, 0.65]
    assert [progress.fraction for progress in seen] == pytest.approx(expected)


def test_closing_closes_what_runs_within():
    log = []
    steps = within(counting(3, log), 0.0, 1.0)
    next(steps)
    steps.close()
    assert log == ["closed"]
