"""The places that a run writes to, and which of them belong to what an input refers to.

Libraries, materials and textures are known when an input is loaded, not before.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ....core.errors import DecompositionError
from .claims import place_key, place_of


class Goals:
    """Refuses outputs in place of files that inputs refer to.

    The `places` are all files of the run, with their companions.
    """

    def __init__(self, places: Iterable[Path]) -> None:
        self._places = {place_key(place_of(path)): path for path in places}
        self._refused: dict[str, str] = {}

    def keep(self, files: Iterable[Path], user: Path) -> None:
        """Keep the files that an input, `user`, refers to: none is written from now on.

        Raises
        ------
        DecompositionError
            If any output of the run would be in the place of one of them.
        """
        found = {}
        for file in files:
            place = place_of(file)
            for each in map(place_key, (place, *place.parents)):
                if each in self._places:
                    found[each] = (
                        f"{self._places[each]} is read as well: {user.name} refers to"
                        " it; give the output another name."
                    )
        self._refused |= found
        if found:
            raise DecompositionError(next(iter(found.values())))

    def check(self, places: Iterable[Path]) -> None:
        """Raise if an input so far refers to what is in one of these places."""
        for path in places if self._refused else ():
            sentence = self._refused.get(place_key(place_of(path)))
            if sentence:
                raise DecompositionError(sentence)
