"""The most memory that the process has held, as the system counts it."""

from __future__ import annotations

import ctypes
import sys


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
