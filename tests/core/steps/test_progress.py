import pytest
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.steps.progress import Progress, in_turn, run, within


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


def test_run_tells_of_progress_and_closes_the_steps_if_that_fails():
    told, log = [], []
    assert run(counting(2), lambda progress: told.append(progress.fraction)) == 2
    assert told == [0.0, 0.5]

    def failing(progress):
        raise ValueError("no")

    steps = counting(2, log)
    with pytest.raises(ValueError, match="no"):
        run(steps, failing)
    assert log == ["closed"]


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


def test_works_in_turn_share_the_progress_and_fail_alone():
    def failing():
        yield Progress("Failing", 0.0)
        raise DecompositionError("No.")

    never = DecompositionError("Not even begun.")
    works = [counting(2), failing(), never, counting(4)]
    progress = []

    def watched():
        steps = in_turn(works, "abcd")
        while True:
            try:
                progress.append(next(steps))
            except StopIteration as stop:
                return stop.value

    two, error, same, four = watched()
    assert (two, str(error), same, four) == (2, "No.", never, 4)
    assert [p.fraction for p in progress] == sorted(p.fraction for p in progress)
    assert progress[0] == Progress("a: Counting", 0.0)
    assert progress[-1].fraction == pytest.approx(0.75 + 0.25 * 0.75)


def test_a_work_alone_keeps_its_stages_and_closes():
    log = []
    steps = in_turn([counting(3, log)], ["alone"])
    assert next(steps) == Progress("Counting", 0.0)
    steps.close()
    assert log == ["closed"]
