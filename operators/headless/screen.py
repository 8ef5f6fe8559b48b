"""Shows progress, results, warnings and errors in the terminal."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import TextIO

from ...core.steps.progress import Progress, Steps, T, run
from .formats import one_line
from .request.option_names import with_options
from .stages import Stages

# Time between two lines of progress at least.
_TERMINAL_SECONDS = 0.1
_LOG_SECONDS = 2.0


class StreamError(Exception):
    """Standard output or standard error takes no more text."""


class Screen:
    """Writes results to one stream; progress, warnings and errors to another.

    Parameters
    ----------
    out, err : text streams
        If `err` is a terminal, progress is one line that is overwritten.
    quiet : bool
        Show warnings and errors only.
    clock : callable, optional
        Returns seconds; tests pass their own.

    Attributes
    ----------
    stages : Stages
        Counts the time of the computations that are followed.
    """

    def __init__(
        self,
        out: TextIO,
        err: TextIO,
        quiet: bool,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.stages = Stages()
        self._out = out
        self._err = err
        self._quiet = quiet
        self._clock = clock
        self._line = ""
        self._stage = ""
        self._next = 0.0

    def result(self, text: str) -> None:
        """Show a result."""
        if not self._quiet:
            self._wipe()
            write(self._out, f"{one_line(text)}\n")

    def warning(self, sentence: str, title: str = "") -> None:
        """Show a warning; `title` says what it is about, such as an object's name."""
        self._say("warning", title, sentence)

    def error(self, sentence: str, title: str = "") -> None:
        """Show an error; `title` says what it is about, such as an object's name."""
        self._say("error", title, sentence)

    def _say(self, kind: str, title: str, sentence: str) -> None:
        """Show a sentence; names in the title are not those of settings."""
        self._wipe()
        about = f"{title}: " if title else ""
        write(self._err, f"{kind}: {one_line(about + with_options(sentence))}\n")

    def follow(self, title: str, steps: Steps[T]) -> T:
        """Finish a computation, show its progress and return its value."""
        return run(self.stages.watched(steps), partial(self.progress, title))

    def progress(self, title: str, progress: Progress) -> None:
        """Show where a computation stands, unless something was just shown."""
        if self._quiet or self._clock() < self._next:
            return
        line = one_line(f"{title}: {progress.stage}")
        if self._err.isatty():
            self._next = self._clock() + _TERMINAL_SECONDS
            self._wipe()
            self._line = f"{line} {progress.fraction:4.0%}"
            write(self._err, self._line)
        elif line != self._stage:
            self._next = self._clock() + _LOG_SECONDS
            self._stage = line
            write(self._err, f"{line} ({progress.fraction:.0%})\n")

    def _wipe(self) -> None:
        """Erase the line of progress in the terminal."""
        if self._line:
            write(self._err, "\r" + " " * len(self._line) + "\r")
            self._line = ""


def progress_title(title: str, number: int, total: int) -> str:
    """Return the title of an object's progress, with its number if there are many."""
    return f"{title} (object {number:,} of {total:,})" if total > 1 else title


def write(stream: TextIO, text: str) -> None:
    """Write text; escape characters that the stream cannot encode.

    Raises
    ------
    StreamError
        If the disk is full, or the program that reads the text has ended.
    """
    encoding = stream.encoding or "utf-8"
    try:
        stream.write(text.encode(encoding, "backslashreplace").decode(encoding))
        stream.flush()
    except OSError as error:
        raise StreamError(
            f"What the command prints cannot be written ({error.strerror})."
        ) from error


def open_closed_streams() -> bool:
    """Discard what goes to a standard stream that is closed from the start.

    Returns
    -------
    bool
        Whether standard output was open.
    """
    open_before = sys.stdout is not None
    for descriptor, name in ((1, "stdout"), (2, "stderr")):
        if getattr(sys, name) is None:
            _discard(descriptor)
            setattr(sys, name, os.fdopen(descriptor, "w", encoding="utf-8"))
    return open_before


def stop_printing(error: StreamError) -> None:
    """Say why printing ends, unless nobody reads it; discard what comes later."""
    if not isinstance(error.__cause__, BrokenPipeError):
        with suppress(StreamError):
            write(sys.stderr, f"error: {error}\n")
    _discard(1)
    _discard(2)


def _discard(descriptor: int) -> None:
    """Send what is written to a file descriptor nowhere."""
    null = os.open(os.devnull, os.O_WRONLY)
    if null != descriptor:  # the lowest that is free, so perhaps this one
        os.dup2(null, descriptor)
        os.close(null)
