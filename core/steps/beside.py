"""Long calls of libraries, which run beside the caller."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from threading import Thread

from .progress import Progress, Steps, T

# Seconds between two reports.
_PAUSE = 0.02


def beside(call: Callable[[], T], progress: Progress) -> Steps[T]:
    """Run one long call in a thread, and report until it ends.

    The caller stays alive only while the library lets other threads run, as Qhull and
    NumPy's sorting do. Linear algebra has no place here: its rounding would depend on
    the number of cores, see `on_one_thread`. A call that nobody waits for any longer
    goes on to its end, and keeps no program from closing.

    Parameters
    ----------
    call : callable
        Takes nothing.
    progress : Progress
        What is reported meanwhile.

    Returns
    -------
    Steps
        With the value of the call, or its exception.
    """
    outcome: Future[T] = Future()

    def work() -> None:
        try:
            outcome.set_result(call())
        except BaseException as error:  # the caller's to handle
            outcome.set_exception(error)

    Thread(target=work, daemon=True).start()
    while True:
        try:
            return outcome.result(_PAUSE)
        except TimeoutError:
            if outcome.done():  # the call's own
                raise
            yield progress
