"""Attempts that may fail without ending the run."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ....core.errors import DecompositionError
from ..screen import Screen


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

    def failed(self, text: str) -> None:
        """Show and note an error."""
        self._screen.error(text)
        self.errors.append(text)

    def written(
        self, path: Path | None, write: Callable[[Path], tuple[str, ...] | None]
    ) -> Path | None:
        """Write to `path`; return it, or None if there is none or writing fails.

        Sentences to the user that are returned by what writes are shown.
        """
        if path is None:
            return None
        try:
            notes = write(path)
        except DecompositionError as error:
            self.failed(str(error))
            return None
        for note in notes or ():
            self._screen.warning(note, str(path))
        return path
