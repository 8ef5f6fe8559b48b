"""Linear algebra on one thread: results do not depend on the number of cores."""

from __future__ import annotations

from threadpoolctl import ThreadpoolController

from .progress import Steps, T


def on_one_thread(steps: Steps[T]) -> Steps[T]:
    """Run `steps` with linear algebra limited to one thread.

    With more threads, the rounding of sums would depend on the number of cores. Where
    other programs keep the cores busy, threads would wait for each other most of the
    time.

    Parameters
    ----------
    steps : Steps
        The computation.

    Returns
    -------
    Steps
        The same reports and the same value.
    """
    controller = ThreadpoolController()
    try:
        while True:
            with controller.limit(limits=1):
                try:
                    progress = next(steps)
                except StopIteration as stop:
                    value: T = stop.value
                    return value
            yield progress
    finally:
        steps.close()
