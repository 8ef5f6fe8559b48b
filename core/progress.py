"""Long computations as generators that report where they are."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import TypeVar

T = TypeVar("T")


@dataclass(frozen=True)
class Progress:
    """Where a computation stands.

    Attributes
    ----------
    stage : str
        What is being done, in the user's words.
    fraction : float
        Share of the whole computation that is done, in 0…1.
    """

    stage: str
    fraction: float


Steps = Generator[Progress, None, T]


def run(steps: Steps[T]) -> T:
    """Exhaust `steps` without a pause and return their value."""
    while True:
        try:
            next(steps)
        except StopIteration as stop:
            value: T = stop.value
            return value


def mapped(steps: Steps[T], change: Callable[[Progress], Progress]) -> Steps[T]:
    """Run `steps` with `change` applied to each progress that they report."""
    try:
        while True:
            try:
                progress = next(steps)
            except StopIteration as stop:
                value: T = stop.value
                return value
            yield change(progress)
    finally:
        steps.close()


def within(steps: Steps[T], low: float, high: float) -> Steps[T]:
    """Run `steps` as the part from `low` to `high` of a longer computation."""
    return mapped(steps, lambda p: Progress(p.stage, low + (high - low) * p.fraction))
