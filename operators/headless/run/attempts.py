"""Attempts that may fail without ending the run."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from ....core.errors import DecompositionError
from ..screen import Screen

T = TypeVar("T")


class Attempts:
    """Tries one thing after another; shows and notes each error, then goes on.

    Parameters
    ----------
    screen : Screen
        Where errors are shown.

    Attributes
    ----------
    errors : list of str
        The errors so far.
    """

    def __init__(self, screen: Screen) -> None:
        self._screen = screen
        self.errors: list[str] = []

    def value(self, make: Callable[[], T]) -> T | None:
        """Return the value of `make`, None if that fails."""
        try:
            return make()
        except DecompositionError as error:
            self.failed(str(error))
            return None

    def failed(self, text: str) -> None:
        """Show and note an error."""
        self._screen.error(text)
        self.errors.append(text)

    def written(self, path: Path | None, write: Callable[[Path], None]) -> Path | None:
        """Write to `path`; return it, or None if there is none or writing fails."""
        if path is None:
            return None

        def write_it() -> Path:
            write(path)
            return path

        return self.value(write_it)
