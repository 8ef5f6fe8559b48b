"""Find the parts for other numbers ahead, in slices, while nothing else runs.

Nothing is written. The session's cache keeps what is found, so that parts follow at
once when their number is asked for.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from typing import TypeAlias

import bpy

from ...core.errors import DecompositionError
from ...core.parameters.parameter import field_of, info_of
from ...core.parameters.parts import Parameters
from ...core.steps.job import Job
from ...core.steps.progress import Steps, T
from ..bridge.watching import start_timer, stop_timer
from ..bridge.work.run_edit import Edited
from ..bridge.work.session_cache import session_cache
from . import modal, refine

# Parameters, and whether a first look at the parts is enough.
Wanted: TypeAlias = tuple[Parameters, bool]

# What is added to the number of parts. One more or less comes first.
_NEAR = (1, -1, 2, -2)
# The highest number that sliders show.
_USUAL = int(info_of(field_of(Parameters, "parts")).usual)
# With more faces the parts themselves are found for near numbers only: all take long.
_MOST_FACES = 40_000
# Seconds of work in a slice. Steps end some 20 ms late.
_SLICE = 0.02
# Seconds between two slices of first looks, which the hand may soon ask for, and of the
# parts themselves: these take longer, and the view should turn smoothly meanwhile.
_PAUSE, _REST = 0.005, 0.03

# What is still to be found, and what is being found.
_wanted: list[Wanted] = []
_current: tuple[Wanted, Job[object]] | None = None


def start(found: Edited) -> None:
    """Find parts of the latest shape for other numbers than that of a run, from now on.

    First come looks at those for all usual numbers, then the parts themselves, for near
    numbers before the others. Of large meshes only those for near numbers are found:
    others would take long. Of the looks, that for the highest number comes first: its
    eigenvectors, which take longest, serve all high numbers. Nothing is found if some
    faces are not free.
    """
    if found.by_hand is not None or found.faces is not None:
        return
    n_parts = found.decomposition.n_parts
    near = _with_numbers(found.parameters, [n_parts + step for step in _NEAR])
    usual = _with_numbers(found.parameters, range(2, _USUAL + 1))
    looks = dict.fromkeys((*usual[-1:], *near, *usual))
    is_large = len(found.decomposition.labels) > _MOST_FACES
    exact = near if is_large else dict.fromkeys((*near, *usual))
    _wanted[:] = [*((each, True) for each in looks), *((each, False) for each in exact)]
    if not bpy.app.background:
        start_timer(go_on, _PAUSE)


def _with_numbers(parameters: Parameters, numbers: Iterable[int]) -> list[Parameters]:
    """Return the parameters with other numbers of parts, as far as they are allowed."""
    found = []
    for number in numbers:
        with suppress(DecompositionError):
            found.append(replace(parameters, parts=number))
    return found


def go_on() -> float | None:
    """Work for a slice; return when to go on, None if all is found."""
    global _current
    if modal.busy() or refine.working():
        return _PAUSE
    if _current is None:
        steps = session_cache().find_ahead(*_wanted[0]) if _wanted else None
        if steps is None:
            _wanted.clear()
            return None
        _current = _wanted.pop(0), Job(steps)
    (_, is_look), job = _current
    if job.advance(_SLICE):
        _current = None
    return _PAUSE if is_look else _REST


def after_rest(wanted: Wanted, steps: Steps[T]) -> Steps[T]:
    """Run `steps`, which find parts too; find the rest first of those half found."""
    if _current is not None and _current[0] == wanted:
        yield from _current[1].rest()
    return (yield from steps)


def stop(*_: object) -> None:
    """Find nothing any more. Blender passes arguments to handlers."""
    global _current
    _wanted.clear()
    if _current is not None:
        _current[1].cancel()
    _current = None
    stop_timer(go_on)


HANDLERS = {"load_pre": stop}
