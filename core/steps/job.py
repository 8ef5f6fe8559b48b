"""A computation advanced in slices of time, so that a window stays alive."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Generic, TypeVar

from .progress import Progress, Steps

T = TypeVar("T")


class Job(Generic[T]):
    """Advances `Steps` within a budget of time, and cancels them.

    Parameters
    ----------
    steps : Steps
        The computation.
    clock : callable, optional
        Returns seconds; tests pass their own.
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
        """Work for about `budget` seconds; return whether the job is done.

        Raises
        ------
        RuntimeError
            If the job was cancelled, or has failed before.
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
        """Return the value of a job that is done."""
        if not self.done:
            raise RuntimeError("the job is not done")
        return self._value  # type: ignore[return-value]  # set with `done`

    def cancel(self) -> None:
        """Stop the computation; its `finally` clauses run."""
        self._ended = True
        self._steps.close()
