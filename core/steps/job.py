"""Computations advanced in slices of time, so that a window stays responsive."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Generic

from .progress import Progress, Steps, T


class Job(Generic[T]):
    """Runs `Steps` in slices of time, and can cancel them.

    Parameters
    ----------
    steps : Steps
        The computation.
    clock : callable, optional
        Returns the time in seconds. Tests pass their own.

    Attributes
    ----------
    progress : Progress
        The latest report of the computation.
    done : bool
        Whether the computation has returned its value.
    """

    def __init__(
        self, steps: Steps[T], clock: Callable[[], float] = time.perf_counter
    ) -> None:
        self._steps = steps
        self._clock = clock
        self.progress = Progress("Starting", 0.0)
        self.done = False
        self._ended = False
        self._value: T | None = None

    def advance(self, budget: float) -> bool:
        """Run the computation for about `budget` seconds.

        Parameters
        ----------
        budget : float
            Time in seconds. At least one step is run.

        Returns
        -------
        done : bool
            Whether the computation is finished.

        Raises
        ------
        RuntimeError
            If the job was cancelled, or an earlier call failed.
        """
        deadline = self._clock() + budget
        while not self.done:
            if self._ended:
                raise RuntimeError("the job was cancelled or has failed")
            self._ended = True
            try:
                self.progress = next(self._steps)
                self._ended = False
            except StopIteration as stop:
                self._value = stop.value
                self.done = True
            if self._clock() >= deadline:
                break
        return self.done

    def result(self) -> T:
        """Return the value of the finished computation.

        Returns
        -------
        value
            The return value of the steps.

        Raises
        ------
        RuntimeError
            If the job is not done.
        """
        if not self.done:
            raise RuntimeError("the job is not done")
        return self._value  # type: ignore[return-value]  # set with `done`

    def rest(self) -> Steps[T]:
        """Run what is left as part of another computation.

        Returns
        -------
        Steps
            With the same value. Steps may be run between them by `advance`, too.

        Raises
        ------
        RuntimeError
            If the job was cancelled, or an earlier call failed.
        """
        while not self.advance(0.0):
            yield self.progress
        return self.result()

    def cancel(self) -> None:
        """Stop the computation and run its `finally` clauses."""
        self._ended = True
        self._steps.close()
