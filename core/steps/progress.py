"""Long computations as generators that report their progress."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from dataclasses import dataclass
from typing import TypeVar

from ..errors import DecompositionError

T = TypeVar("T")


@dataclass(frozen=True)
class Progress:
    """One progress report of a computation.

    Attributes
    ----------
    stage : str
        The current stage, in words for the user.
    fraction : float
        Finished share of the whole computation, in 0…1.
    """

    stage: str
    fraction: float


Steps = Generator[Progress, None, T]


def run(steps: Steps[T], tell: Callable[[Progress], None] | None = None) -> T:
    """Run `steps` to the end without a pause and return their value.

    Parameters
    ----------
    steps : Steps
        The computation.
    tell : callable, optional
        Takes each `Progress` that the computation reports.

    Returns
    -------
    value
        The return value of the steps.

    Examples
    --------
    >>> from weak_convex_decomposition.core.steps.progress import Progress, run
    >>> def count():
    ...     yield Progress("Counting", 0.0)
    ...     return 3
    >>> run(count())
    3
    """
    with closing(steps):  # even if `tell` raises
        while True:
            try:
                progress = next(steps)
            except StopIteration as stop:
                return stop.value
            if tell is not None:
                tell(progress)


def as_steps(value: T) -> Steps[T]:
    """Return steps that return a value at once."""
    yield from ()
    return value


def mapped(steps: Steps[T], change: Callable[[Progress], Progress]) -> Steps[T]:
    """Run `steps` and change each of their progress reports.

    Parameters
    ----------
    steps : Steps
        The computation.
    change : callable
        Takes the `Progress` that the computation reports, returns the one to report.

    Returns
    -------
    Steps
        With the same value.
    """
    with closing(steps):
        while True:
            try:
                progress = next(steps)
            except StopIteration as stop:
                return stop.value
            yield change(progress)


def within(steps: Steps[T], low: float, high: float) -> Steps[T]:
    """Run `steps` as the section from `low` to `high` of a longer computation.

    Parameters
    ----------
    steps : Steps
        The computation. It reports fractions from 0 to 1.
    low, high : float
        Fractions of the longer computation where the section begins and ends.

    Returns
    -------
    Steps
        With the same value.
    """
    return mapped(steps, lambda p: Progress(p.stage, low + (high - low) * p.fraction))


def within_turn(steps: Steps[T], turn: int, n_turns: int) -> Steps[T]:
    """Run `steps` as one of `n_turns` equal sections of a longer computation.

    Parameters
    ----------
    steps : Steps
        The computation. It reports fractions from 0 to 1.
    turn : int
        Number of the section, from 0.
    n_turns : int
        Number of sections.

    Returns
    -------
    Steps
        With the same value.
    """
    return within(steps, turn / n_turns, (turn + 1) / n_turns)


def in_turn(
    works: Sequence[Steps[T] | DecompositionError], names: Sequence[str]
) -> Steps[list[T | DecompositionError]]:
    """Run several computations one after the other, even if some of them fail.

    Parameters
    ----------
    works : sequence of Steps or DecompositionError
        An error stands for a computation that could not begin.
    names : sequence of str
        Name of each computation. Reports begin with it if there are several.

    Returns
    -------
    Steps of list
        For each computation its value, or the `DecompositionError` that ended it.
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
    """Run `steps` and put a title before each stage that they report."""
    return mapped(steps, lambda p: Progress(f"{title}: {p.stage}", p.fraction))
