"""The files that each input is written to, checked before any work is done."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from ....core.errors import DecompositionError
from ..files.claims import check_companion, check_distinct, companion_of
from ..files.output_folders import check_outside
from ..files.replacing import explaining, is_stream
from ..formats import (
    HULL_ENDINGS,
    HULLS_WITHIN_ENDINGS,
    MODEL_ENDINGS,
    PICTURE_ENDINGS,
    READ_ENDINGS,
)

_NAME = "{name}"
_FIELD = re.compile(r"\{[a-z]+\}", re.IGNORECASE)
# Standard input among the inputs, standard output for the report.
STANDARD_STREAM = Path("-")


@dataclass(frozen=True)
class Targets:
    """The files to write for one input, None for those that are not asked for."""

    output: Path | None = None
    picture: Path | None = None
    hulls: Path | None = None

    @property
    def show_parts(self) -> bool:
        """Whether parts are what is asked for: not if hulls alone are."""
        return bool(self.output or self.picture or not self.hulls)

    def places(self) -> Iterator[Path]:
        """Yield the files, and what is written beside them."""
        for file in (self.output, self.picture, self.hulls):
            if file:
                yield file
                companion = companion_of(file, is_model=file == self.output)
                if companion:
                    yield companion


def targets_for(
    inputs: Sequence[Path],
    output: str | None,
    picture: str | None,
    report: Path | None,
    hulls: str | None,
    with_hulls: bool,
) -> tuple[Targets, ...]:
    """Return the targets of each input.

    Parameters
    ----------
    inputs : sequence of Path
    output, picture, hulls : str or None
        Files to write; {name} in them stands for the name of the input.
    report : Path or None
        Checked together with the others.
    with_hulls : bool
        Whether hulls belong into the output, too.

    Raises
    ------
    DecompositionError
        If a target cannot be written, is an input, or would be written twice.
    """
    _check_asked(output, report, with_hulls)
    with explaining(Path(), "read"):
        Path.cwd()  # it may be gone, and paths count from it
    endings = HULLS_WITHIN_ENDINGS if with_hulls else MODEL_ENDINGS
    option = "--output, with --with-hulls," if with_hulls else "--output"
    outputs = _resolved(inputs, output, option, endings)
    pictures = _resolved(inputs, picture, "--picture", PICTURE_ENDINGS)
    hull_files = _resolved(inputs, hulls, "--hulls", HULL_ENDINGS)
    files = [file for file in (*outputs, *pictures, *hull_files, report) if file]
    files = [file for file in files if file != STANDARD_STREAM]
    companions = {
        file: companion
        for some, is_model in ((outputs, True), (hull_files, False))
        for file in some
        if file and (companion := companion_of(file, is_model))
    }
    for file in files:
        with explaining(file, "written"):
            _check_writable(file)
    check_distinct([*files, *companions.values()], inputs)
    for file, companion in companions.items():
        with explaining(companion, "written"):
            check_companion(file, companion)
    return tuple(map(Targets, outputs, pictures, hull_files))


def _check_asked(output: str | None, report: Path | None, with_hulls: bool) -> None:
    """Check that what is asked for has one meaning."""
    if with_hulls and output is None:
        raise DecompositionError(
            "--with-hulls needs --output, which names the file for model and hulls."
        )
    if report and _NAME in str(report):
        raise DecompositionError(
            f"One report tells of all inputs; leave {_NAME} out of --report."
        )
    ending = report.suffix.lower() if report else ""
    if ending in (*READ_ENDINGS, *HULL_ENDINGS, *PICTURE_ENDINGS):
        raise DecompositionError(
            f"--report writes JSON; name a file that ends in .json, not in {ending}."
        )


def _resolved(
    inputs: Sequence[Path], pattern: str | None, option: str, endings: tuple[str, ...]
) -> list[Path | None]:
    """Return the file for each input; `pattern` may have {name} in it."""
    if pattern is None:
        return [None] * len(inputs)
    if Path(pattern).suffix.lower() not in endings:
        raise DecompositionError(f"{option} has to end in one of {' '.join(endings)}.")
    unknown = set(_FIELD.findall(pattern)) - {_NAME}
    if unknown:
        raise DecompositionError(
            f"{option} has {min(unknown)} in it; write {_NAME}, which stands for the"
            " name of each input, or leave it out."
        )
    if len(inputs) > 1 and _NAME not in pattern:
        raise DecompositionError(
            f"{option} needs {_NAME} in it, which stands for the name of each input,"
            " when there are several."
        )
    return [Path(pattern.replace(_NAME, path.stem)) for path in inputs]


def _check_writable(file: Path) -> None:
    """Raise if `file` cannot be created or replaced; its folder may be missing."""
    with suppress(FileNotFoundError, NotADirectoryError):
        file.stat()  # links in a circle, and names that are too long, are errors
    if is_stream(file):
        return
    if file.is_dir():
        raise DecompositionError(f"{file} is a folder; name a file in it.")
    if file.exists() and not _may(file, os.W_OK):
        raise DecompositionError(f"{file} cannot be written: it is read-only.")
    folder = next(each for each in file.resolve().parents if each.exists())
    if not folder.is_dir():
        raise DecompositionError(
            f"{file} cannot be written: {folder} is a file, not a folder."
        )
    if not _may(folder, os.W_OK | os.X_OK):
        raise DecompositionError(
            f"{file} cannot be written: the folder {folder} is read-only."
        )
    check_outside(file)


def _may(path: Path, mode: int) -> bool:
    """Return whether this process has rights to a path."""
    effective = os.access in os.supports_effective_ids
    return os.access(path, mode, effective_ids=effective)
