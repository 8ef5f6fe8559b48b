"""Linear algebra on one thread: results do not depend on the number of cores."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import lru_cache, wraps
from typing import ParamSpec

from threadpoolctl import ThreadpoolController

from .progress import Steps, T

Given = ParamSpec("Given")


def on_one_thread(compute: Callable[Given, Steps[T]]) -> Callable[Given, Steps[T]]:
    """Limit the linear algebra of a computation to one thread.

    With more threads, the rounding of sums would depend on the number of cores. Where
    other programs keep the cores busy, threads would wait for each other most of the
    time.

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
                with controller.limit(limits=1):
                    try:
                        progress = next(steps)
                    except StopIteration as stop:
                        value: T = stop.value
                        return value
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
