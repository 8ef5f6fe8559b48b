"""Silences what Blender prints, so that our output stays readable."""

from __future__ import annotations

import ctypes
import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout


def _flush() -> None:
    """Flush the output of Python and of the C library that Blender prints with."""
    sys.stdout.flush()
    sys.stderr.flush()
    library = ctypes.cdll.ucrtbase if os.name == "nt" else ctypes.CDLL(None)
    library.fflush(None)


@contextmanager
def quiet_blender() -> Iterator[None]:
    """Discard what importers, exporters and graphics drivers print.

    They print from Python and from C, so both `sys.stdout` and the file descriptors
    are redirected. The stream that replaces `sys.stdout` is never closed: the glTF
    add-on keeps it for its log.
    """
    _flush()
    kept = [(os.dup(descriptor), descriptor) for descriptor in (1, 2)]
    null = os.open(os.devnull, os.O_WRONLY)
    try:
        for _, descriptor in kept:
            os.dup2(null, descriptor)
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
            yield
    finally:
        _flush()
        for copy, descriptor in kept:
            os.dup2(copy, descriptor)
            os.close(copy)
        os.close(null)
