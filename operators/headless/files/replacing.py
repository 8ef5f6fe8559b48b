"""Files that are written whole or not at all, and why writing failed."""

from __future__ import annotations

import re
import shutil
import stat
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ....core.errors import DecompositionError
from ..formats import SIMULATOR_ENDINGS
from .swap import swap
from .whole import check_whole, raise_cause

# Paths that stand for an open stream, whatever they are when they are looked at.
_STREAMS = ("/dev/stdout", "/dev/stderr", "/dev/fd/", "/proc/")
# What Python and Blender put before the cause, and what comes after it.
_NOISE = re.compile(r"^(Error: |\w*Error: |\[Errno \d+\] )+|: '[^']*'$|\.$")


@contextmanager
def replacing(
    path: Path, *companions: Path, owned: Callable[[], frozenset[str]] = frozenset
) -> Iterator[Path]:
    """Give the path of a new file; put that in the place of `path` if it is whole.

    The new file is beside the old one, so that paths in it are right. If the block
    raises, or the file is not whole, everything stays as it was. Folders that are
    missing are made. Links stay: what they point to is replaced. A pipe or a device is
    written to.

    Parameters
    ----------
    path : Path
    *companions : Path
        What else is replaced with `path`, if the block writes it: a folder beside the
        new file under its own name, or a file that differs from the new file in its
        ending, as exporters of .obj write materials.
    owned : callable, optional
        Returns the names in an old folder that are ours and may go. It is called when
        all is written, and may raise.

    Raises
    ------
    OSError
        If a file cannot be written, or is not whole.
    """
    stream = is_stream(path)
    goals = [_goal(each) for each in companions]
    goals += [] if stream else [_goal(path)]
    with _new_folders(goals), _stage(goals[-1] if goals else None) as stage:
        has_folder = path.suffix.lower() in SIMULATOR_ENDINGS
        unfinished = _unfinished(stage, path, has_folder)
        try:
            yield unfinished
        except RuntimeError:  # of Blender, which often does not know why
            raise_cause(unfinished)
            raise
        made = [_unfinished(stage, each, has_folder) for each in companions]
        made.append(unfinished)
        _check_all(unfinished, made)
        moves = [each for each in zip(made, goals, strict=False) if each[0].exists()]
        swap(moves, owned())
        if stream:
            with unfinished.open("rb") as new, path.open("wb") as old:
                shutil.copyfileobj(new, old)


def _unfinished(stage: Path, path: Path, has_folder: bool) -> Path:
    """Return where the new one for `path` is written.

    Files that name a folder beside them, and that folder, keep their names.
    """
    if has_folder or len(path.suffix) < 2:
        return stage / path.name
    return stage.with_name(stage.name + path.suffix)


def _check_all(unfinished: Path, made: list[Path]) -> None:
    """Check that all new files are whole; those of a folder, too."""
    check_whole(unfinished)
    for each in made:
        for file in (each, *each.rglob("*")):
            if file.is_file() and file != unfinished:
                check_whole(file)


def _goal(path: Path) -> Path:
    """Return what `path` stands for, with links followed; it may be missing."""
    with suppress(FileNotFoundError):
        path.stat()  # links in a circle are an error
    return path.resolve()


def is_stream(path: Path) -> bool:
    """Return whether `path` is written to, not replaced: a pipe, a device, a stream."""
    if str(path.absolute()).startswith(_STREAMS):
        return True
    try:
        mode = path.stat().st_mode
    except OSError:
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


@contextmanager
def _new_folders(goals: list[Path]) -> Iterator[None]:
    """Make the folders of `goals`; remove those that are new if the block fails."""
    made: list[Path] = []
    try:
        for goal in goals:
            missing = [each for each in goal.parents if not each.exists()]
            made = [*missing, *made]  # the innermost first
            goal.parent.mkdir(parents=True, exist_ok=True)
        yield
    except BaseException:
        for folder in made:
            with suppress(OSError):  # somebody else may use it by now
                folder.rmdir()
        raise


@contextmanager
def _stage(goal: Path | None) -> Iterator[Path]:
    """Make a folder beside `goal`; remove it, and files of its name, at the end."""
    folder = Path(tempfile.mkdtemp(prefix=".wcd-", dir=goal.parent if goal else None))
    try:
        yield folder
    finally:
        for each in folder.parent.glob(f"{folder.name}*"):  # also of Blender's own
            if each.is_dir():
                shutil.rmtree(each, ignore_errors=True)
            else:
                each.unlink(missing_ok=True)


@contextmanager
def explaining(path: Path, action: str) -> Iterator[None]:
    """Turn a failure into a sentence: `path` cannot be "written", and why.

    Raises
    ------
    DecompositionError
        In place of the errors of Blender's operators and of the file system.
    """
    try:
        yield
    except (RuntimeError, OSError) as error:
        # The text of an OSError would name the unfinished file.
        reason = getattr(error, "strerror", None) or last_reason(str(error))
        if reason == KeyboardInterrupt.__name__:  # of an exporter in Python
            raise KeyboardInterrupt from error
        raise DecompositionError(f"{path} cannot be {action} ({reason}).") from error


def last_reason(text: str) -> str:
    """Return the cause in the text of one of Blender's errors, without its noise.

    Operators in Python give a traceback, and after it the place that called them.
    """
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    lines = [line for line in lines if not line.startswith("Location:")]
    return _NOISE.sub("", lines[-1]) if lines else "Blender gives no reason"
