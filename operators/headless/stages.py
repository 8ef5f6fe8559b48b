"""Seconds and memory of the stages of a run, for the report."""

from __future__ import annotations

import ctypes
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from ...core.steps.progress import Steps, T

# The stages of the report, in their order.
STAGES = ("read", "prepare", "lines_of_sight", "clusters", "seams", "hulls", "write")
# The stage of the report for each stage that progress names; "hulls" for all others.
STAGE_OF = {
    "Starting": "prepare",
    "Libraries": "prepare",
    "Surface": "prepare",
    "Normals": "prepare",
    "Splats": "prepare",
    "Samples": "lines_of_sight",
    "Ray tree": "lines_of_sight",
    "Lines of sight": "lines_of_sight",
    "Containers": "lines_of_sight",
    "Patches": "clusters",
    "Number of parts": "clusters",
    "Details": "clusters",
    "Symmetry": "clusters",
    "Seams": "seams",
    "Writing": "write",
}


@dataclass
class Stage:
    """What a stage took.

    Attributes
    ----------
    seconds : float
        Of all objects together.
    peak_memory : int or None
        The most bytes that the process had held by the end of the stage.
    """

    seconds: float = 0.0
    peak_memory: int | None = None


class Stages:
    """Seconds and memory by stage.

    Parameters
    ----------
    clock : callable, optional
        Returns seconds; tests pass their own.

    Attributes
    ----------
    stages : dict of str to Stage
        By the names in `STAGES`, in their order.
    """

    def __init__(self, clock: Callable[[], float] = time.perf_counter) -> None:
        self.stages = {name: Stage() for name in STAGES}
        self._clock = clock

    @contextmanager
    def during(self, name: str) -> Iterator[None]:
        """Count the time within a `with` block to a stage."""
        started = self._clock()
        try:
            yield
        finally:
            self.stages[name].seconds += self._clock() - started
            self._ends(name)

    def watched(self, steps: Steps[T]) -> Steps[T]:
        """Run `steps`; count the time after each report to the stage it names."""
        name, started = "prepare", self._clock()
        try:
            while True:
                try:
                    progress = next(steps)
                except StopIteration as stop:
                    value: T = stop.value
                    return value
                finally:
                    self.stages[name].seconds += self._clock() - started
                yield progress
                if (next_name := STAGE_OF.get(progress.stage, "hulls")) != name:
                    self._ends(name)
                    name = next_name
                started = self._clock()
        finally:
            steps.close()
            self._ends(name)

    def _ends(self, name: str) -> None:
        """Note the memory at the end of a stage; the system is slow to tell it."""
        self.stages[name].peak_memory = peak_memory()


class _Counters(ctypes.Structure):
    """PROCESS_MEMORY_COUNTERS of Windows."""

    _fields_ = (
        ("cb", ctypes.c_uint32),
        ("PageFaultCount", ctypes.c_uint32),
        ("PeakWorkingSetSize", ctypes.c_size_t),
        *((f"unused_{number}", ctypes.c_size_t) for number in range(7)),
    )


def peak_memory() -> int | None:
    """Return the most bytes that the process held in memory at any time so far.

    Returns
    -------
    int or None
        None where the system does not tell.
    """
    if sys.platform == "win32":
        return _peak_on_windows()
    import resource  # Windows has no such module

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else peak * 1024


def _peak_on_windows() -> int | None:
    """Return the peak working set; `getattr` since other systems lack the library."""
    kernel = getattr(ctypes, "windll").kernel32  # noqa: B009
    kernel.GetCurrentProcess.restype = ctypes.c_void_p
    counters = _Counters(cb=ctypes.sizeof(_Counters))
    told = kernel.K32GetProcessMemoryInfo(
        ctypes.c_void_p(kernel.GetCurrentProcess()),
        ctypes.byref(counters),
        ctypes.sizeof(counters),
    )
    return int(counters.PeakWorkingSetSize) if told else None
