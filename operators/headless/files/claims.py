"""What an output writes beside itself, and what it must not be written over.

These are inputs and the files that they refer to: libraries, materials and textures,
which are known when an input is loaded, not before.
"""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterable, Sequence
from pathlib import Path

from ....core.errors import DecompositionError
from ..formats import CONTROL_CHARACTERS, SIMULATOR_ENDINGS
from .output_folders import folder_of, owned_names
from .replacing import is_stream

_CONTROL = re.compile(f"[{CONTROL_CHARACTERS}]")
_MATERIALS_LINE = re.compile(rb"^mtllib (.+?)\r?$", re.MULTILINE)


def companion_of(path: Path, is_model: bool) -> Path | None:
    """Return the file or folder that is written beside `path`, None if there is none.

    It may hold the materials of a model; hulls have none.
    """
    ending = path.suffix.lower()
    if ending in SIMULATOR_ENDINGS:
        return folder_of(path)
    return path.with_suffix(".mtl") if is_model and ending == ".obj" else None


def check_companion(path: Path, companion: Path) -> None:
    """Check that what is at the place of a companion of `path` is ours to replace.

    An .mtl file is, if the .obj file that is replaced with it names it. A simulator
    file has to name the folder of its meshes, which is called like it: XML does not
    hold all characters.

    Raises
    ------
    DecompositionError
        If something of the user's would be lost, or `path` cannot name its companion.
    """
    if path.suffix.lower() in SIMULATOR_ENDINGS:
        if _CONTROL.search(path.name):
            raise DecompositionError(
                f"{path} has a name with control characters, or bytes that are no"
                f" Unicode, which {path.suffix} files cannot hold; rename it."
            )
        owned_names(path)
        return
    if not companion.exists():
        return
    names = _MATERIALS_LINE.findall(path.read_bytes()) if path.is_file() else []
    if not companion.is_file() or os.fsencode(companion.name) not in names:
        raise DecompositionError(
            f"{companion} does not belong to {path.name}, whose materials would replace"
            " it; rename one of them."
        )


def check_distinct(outputs: Sequence[Path], inputs: Sequence[Path]) -> None:
    """Raise if an output is written twice, over an input, or within another.

    The companions are among the outputs.
    """
    read = {place_of(path) for path in inputs}
    same = {_identity(path) for path in inputs} - {None}
    alike = {place_key(place_of(path)): path for path in inputs}
    taken: dict[str, Path] = {}
    for output in outputs:
        place = place_of(output)
        if place in read or _identity(output) in same:
            raise DecompositionError(
                f"{output} is an input, too; give the output another name."
            )
        other = alike.get(place_key(place)) or taken.setdefault(
            place_key(place), output
        )
        if other is not output:
            raise DecompositionError(_twice(output, other))
    for path in (*outputs, *inputs):
        for folder in place_of(path).parents:
            if place_key(folder) in taken:
                raise DecompositionError(
                    f"{path} is in {taken[place_key(folder)]}, which is written as a"
                    " whole; choose another place for one of them."
                )


def place_of(path: Path) -> Path:
    """Return where a file is in the end; streams and links in a circle stay there."""
    return path.absolute() if is_stream(path) else Path(os.path.realpath(path))


def _identity(path: Path) -> tuple[int, int] | None:
    """Return what is equal for two names of one file, as `A.obj` and `a.obj` may be."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino


def place_key(place: Path) -> str:
    """Return what is equal for paths that some disks take for one."""
    return _composed(place).casefold()


def _composed(path: Path) -> str:
    """Return a path with each accent and its letter as one character."""
    return unicodedata.normalize("NFC", str(path))


def _twice(output: Path, other: Path) -> str:
    """Return the sentence for two outputs in one place."""
    if place_of(output) == place_of(other):
        return (
            f"{output} would be written twice; give inputs and outputs distinct names."
        )
    look_alike = _composed(output) == _composed(other)
    ways = "how accents are stored" if look_alike else "upper and lower case"
    return (
        f"{output} and {other} differ in {ways} alone, and are one file on some disks;"
        " give them distinct names."
    )


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
                        f"{self._places[each]} is read as well: {user} refers to"
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
