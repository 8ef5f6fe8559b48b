"""One thread for linear algebra: the same sums everywhere, and nobody waits."""

from __future__ import annotations

from threadpoolctl import ThreadpoolController

from .progress import Steps, T


def on_one_thread(steps: Steps[T]) -> Steps[T]:
    """Run `steps` with one thread for each product of matrices.

    Otherwise the rounding of sums would depend on the number of cores. Where other
    programs keep the cores busy, threads would wait for each other most of the time.

    Parameters
    ----------
    steps : Steps
        The computation.
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
