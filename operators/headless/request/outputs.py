"""Where the results of each input go, checked before any work is done."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ....core.errors import DecompositionError
from ..write.hull_files import HULL_ENDINGS
from ..write.models import ENDINGS

_NAME = "{name}"


@dataclass(frozen=True)
class Targets:
    """The files that the results of one input go to."""

    output: Path | None
    picture: Path | None
    hulls: Path | None = None


def targets_for(
    inputs: Sequence[Path],
    output: str | None,
    picture: str | None,
    report: Path | None,
    hulls: str | None = None,
) -> tuple[Targets, ...]:
    """Return the targets of each input.

    Raises
    ------
    DecompositionError
        If a target cannot be written, is an input, or would be written twice.
    """
    outputs = _resolved(inputs, output, "--output", ENDINGS)
    pictures = _resolved(inputs, picture, "--picture", (".png",))
    hull_files = _resolved(inputs, hulls, "--hulls", HULL_ENDINGS)
    files = [file for file in (*outputs, *pictures, *hull_files, report) if file]
    files += [file.with_suffix(".mtl") for file in outputs if _has_materials(file)]
    for file in files:
        _check_writable(file)
    _check_distinct(files, inputs)
    return tuple(map(Targets, outputs, pictures, hull_files))


def _has_materials(file: Path | None) -> bool:
    """Return whether a second file is written beside `file`."""
    return file is not None and file.suffix.lower() == ".obj"


def _resolved(
    inputs: Sequence[Path],
    pattern: str | None,
    option: str,
    endings: tuple[str, ...],
) -> list[Path | None]:
    """Return the file that `pattern` means for each input."""
    if pattern is None:
        return [None] * len(inputs)
    if Path(pattern).suffix.lower() not in endings:
        raise DecompositionError(f"{option} has to end in one of {' '.join(endings)}.")
    if len(inputs) > 1 and _NAME not in pattern:
        raise DecompositionError(
            f"{option} needs {_NAME} in it, which stands for the name of each input,"
            " when there are several."
        )
    return [Path(pattern.replace(_NAME, path.stem)) for path in inputs]


def _check_writable(file: Path) -> None:
    """Raise if `file` cannot be made or replaced."""
    if not file.parent.is_dir():
        raise DecompositionError(
            f"{file} cannot be written: there is no folder {file.parent}."
        )
    if file.is_dir():
        raise DecompositionError(f"{file} is a folder; name a file in it.")
    if not os.access(file.parent, os.W_OK):
        raise DecompositionError(
            f"{file} cannot be written: the folder {file.parent} is read-only."
        )


def _check_distinct(files: Sequence[Path], inputs: Sequence[Path]) -> None:
    """Raise if a file would be written twice, or over an input."""
    seen: set[Path] = set()
    read = {path.resolve() for path in inputs}
    for file in files:
        if file.resolve() in read:
            raise DecompositionError(
                f"{file} is an input, too; give the output another name."
            )
        if file.resolve() in seen:
            raise DecompositionError(
                f"{file} would be written twice; give inputs and outputs distinct"
                " names."
            )
        seen.add(file.resolve())
