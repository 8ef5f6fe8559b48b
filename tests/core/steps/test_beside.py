import threading
import time

import pytest
from weak_convex_decomposition.core.steps.beside import beside
from weak_convex_decomposition.core.steps.progress import Progress, run

WAITING = Progress("Waiting", 0.5)


def test_the_value_of_the_call_is_returned():
    assert run(beside(lambda: 3, WAITING)) == 3


def test_the_caller_goes_on_while_the_call_runs():
    may_end = threading.Event()
    steps = beside(may_end.wait, WAITING)
    assert [next(steps) for _ in range(3)] == [WAITING] * 3
    may_end.set()
    assert run(steps)


@pytest.mark.parametrize("error", [ValueError, TimeoutError, KeyboardInterrupt])
def test_an_exception_of_the_call_is_the_callers(error):
    def fail():
        time.sleep(0.05)
        raise error("so it is")

    with pytest.raises(error, match="so it is"):
        run(beside(fail, WAITING))


def test_a_call_that_nobody_waits_for_keeps_no_program_from_closing():
    may_end = threading.Event()
    before = set(threading.enumerate())
    steps = beside(may_end.wait, WAITING)
    next(steps)
    (thread,) = set(threading.enumerate()) - before
    steps.close()
    assert thread.daemon
    may_end.set()
