"""Linear algebra on one thread: results do not depend on the number of cores."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import lru_cache, wraps
from threading import RLock
from typing import ParamSpec

from threadpoolctl import ThreadpoolController

from .progress import Steps, T

Given = ParamSpec("Given")

# Limits hold for the whole process. If two threads set and lifted them in turn, the
# second would keep those of the first. Steps may contain limited steps of their own.
_LIMITED = RLock()


def on_one_thread(compute: Callable[Given, Steps[T]]) -> Callable[Given, Steps[T]]:
    """Limit the linear algebra of a computation to one thread.

    With more threads, the rounding of sums would depend on the number of cores. Where
    other programs keep the cores busy, threads would wait for each other most of the
    time. Computations in several threads take turns, step by step.

    Parameters
    ----------
    compute : callable
        Returns the steps of the computation.

    Returns
    -------
    callable
        Returns steps with the same reports and the same value.
    """

    @wraps(compute)
    def limited(*args: Given.args, **kwargs: Given.kwargs) -> Steps[T]:
        steps, controller = compute(*args, **kwargs), _controller(len(sys.modules))
        try:
            while True:
                with _LIMITED, controller.limit(limits=1):
                    try:
                        progress = next(steps)
                    except StopIteration as stop:
                        return stop.value
                yield progress
        finally:
            steps.close()

    return limited


@lru_cache(maxsize=1)
def _controller(n_modules: int) -> ThreadpoolController:
    """Return what limits the threads of all libraries that are loaded.

    It takes 3 ms to find them: this is done again after modules were imported.
    """
    return ThreadpoolController()
