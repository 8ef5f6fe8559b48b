"""Ctrl-C and other requests to end stop a run in one way: KeyboardInterrupt.

These are SIGTERM, and SIGHUP, which comes when a terminal is closed or a line drops.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_HANGUP = getattr(signal, "SIGHUP", None)  # Windows has none
_SIGNALS = tuple(filter(None, (signal.SIGINT, signal.SIGTERM, _HANGUP)))


class Interrupts:
    """Whether the user or the system wants the run to end."""

    def __init__(self) -> None:
        self._came = False

    def __call__(self, number: int, frame: FrameType | None) -> None:
        """Handle a signal; the shell and the system each send that of a terminal."""
        if self._came and number == _HANGUP:
            return  # the report of what was done is being written
        self._came = True
        raise KeyboardInterrupt

    def check(self) -> None:
        """Raise KeyboardInterrupt if a signal came.

        Blender turns that of an exporter in Python into an error of its own.
        """
        if self._came:
            raise KeyboardInterrupt


@contextmanager
def interruptible() -> Iterator[Interrupts]:
    """Raise KeyboardInterrupt in the block when the user or the system ends the run.

    Blender has a handler of its own for Ctrl-C, which ends the process at once. A
    signal that is ignored from the start stays ignored, as after `nohup`.
    """
    interrupts = Interrupts()
    if threading.current_thread() is not threading.main_thread():
        yield interrupts  # only the main thread receives signals
        return
    before = {
        number: signal.getsignal(number)
        for number in _SIGNALS
        if signal.getsignal(number) is not signal.SIG_IGN
    }
    try:
        for number in before:
            signal.signal(number, interrupts)
        yield interrupts
    finally:
        for number, handler in before.items():
            # None: a handler that Python does not know, and cannot set again.
            signal.signal(number, signal.SIG_DFL if handler is None else handler)
