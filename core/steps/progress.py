"""Long computations as generators that report where they are."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import TypeVar

from ..errors import DecompositionError

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


def within_turn(steps: Steps[T], turn: int, n_turns: int) -> Steps[T]:
    """Run `steps` as one of `n_turns` equal turns of a longer computation."""
    return within(steps, turn / n_turns, (turn + 1) / n_turns)


def in_turn(
    works: Sequence[Steps[T] | DecompositionError], names: Sequence[str]
) -> Steps[list[T | DecompositionError]]:
    """Run several computations one after the other; an error ends its own alone.

    Parameters
    ----------
    works : sequence of Steps
        Or errors: of computations that could not even begin.
    names : sequence of str
        Come before the stages that are reported, where there are several.

    Returns
    -------
    Steps of list
        The values, and the errors in the places of those that failed.
    """
    outcomes: list[T | DecompositionError] = []
    for number, (work, name) in enumerate(zip(works, names, strict=True)):
        if isinstance(work, DecompositionError):
            outcomes.append(work)
            continue
        try:
            steps = within_turn(work, number, len(works))
            outcomes.append((yield from _titled(steps, name) if works[1:] else steps))
        except DecompositionError as error:
            outcomes.append(error)
    return outcomes


def _titled(steps: Steps[T], title: str) -> Steps[T]:
    """Run `steps` with a title before their stages."""
    return mapped(steps, lambda p: Progress(f"{title}: {p.stage}", p.fraction))
