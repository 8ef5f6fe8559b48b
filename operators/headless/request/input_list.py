"""A list of inputs on standard input, one path on each line."""

from __future__ import annotations

import os
import sys
from codecs import BOM_UTF8
from collections.abc import Sequence
from pathlib import Path

from ....core.errors import DecompositionError
from .outputs import STANDARD_STREAM


def all_inputs(given: Sequence[Path]) -> tuple[Path, ...]:
    """Return the inputs, with those on standard input in the place of `-`.

    Raises
    ------
    DecompositionError
        If standard input cannot be read, or names no file.
    """
    if STANDARD_STREAM not in given:
        return tuple(given)
    if given.count(STANDARD_STREAM) > 1:
        raise DecompositionError("INPUT is - twice; standard input is read only once.")
    at = given.index(STANDARD_STREAM)
    return (*given[:at], *_listed(), *given[at + 1 :])


def _listed() -> list[Path]:
    """Return the paths on standard input; empty lines are skipped."""
    if sys.stdin is None:
        raise DecompositionError(
            "INPUT is -, but standard input is closed; write paths to it, one a line."
        )
    try:
        # As bytes: a path need not be text in the encoding of the stream.
        lines = sys.stdin.buffer.read().removeprefix(BOM_UTF8).splitlines()
    except OSError as error:
        raise DecompositionError(
            f"Standard input cannot be read ({error.strerror})."
        ) from error
    if any(b"\0" in line for line in lines):  # of no path, but of "find -print0"
        raise DecompositionError(
            "Standard input has a zero byte, which paths cannot have; write one path a"
            " line, as `find -print` does and `find -print0` does not."
        )
    paths = [Path(os.fsdecode(line)) for line in lines if line.strip()]
    if not paths:
        raise DecompositionError(
            "INPUT is -, but standard input has no line; write paths to it, one a line."
        )
    return paths
