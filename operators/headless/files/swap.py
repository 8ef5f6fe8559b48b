"""New files and folders take the place of old ones: all of them, or none."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from tempfile import TemporaryDirectory


def swap(moves: Sequence[tuple[Path, Path]], owned: frozenset[str]) -> None:
    """Put new files and folders where they belong; if one fails, take all back.

    The system replaces one file in one step. Of several, the last is the one that
    refers to the others. A file is never missing, a folder for a moment.

    Parameters
    ----------
    moves : sequence of (Path, Path)
        A new file or folder, which is whole and on the disk, and its goal. What is at
        the goal is replaced.
    owned : frozenset of str
        Names in an old folder that are ours. All others go to the new folder.

    Raises
    ------
    OSError
        If something cannot be moved; everything is as it was then.
    """
    with ExitStack() as rooms, ExitStack() as back:
        waiting = []
        for new, goal in moves:
            # A folder beside the goal, on its disk: new and old are in it for a while.
            beside = TemporaryDirectory(
                prefix=".wcd-", dir=goal.parent, ignore_cleanup_errors=True
            )
            room = Path(rooms.enter_context(beside))
            _bring(new, room / "new", goal)
            waiting.append((goal, room))
        for goal, room in waiting:
            _replace(goal, room, owned, back)
        back.pop_all()


def _bring(new: Path, there: Path, goal: Path) -> None:
    """Bring a new file or folder near its goal, with the rights of what it replaces."""
    try:
        os.rename(new, there)
    except OSError as error:
        if error.errno != errno.EXDEV:
            raise
        _copy(new, there)
    if goal.exists():
        shutil.copymode(goal, there)


def _copy(new: Path, there: Path) -> None:
    """Copy a file or a folder to another disk, and wait until it is there."""
    if new.is_dir():
        shutil.copytree(new, there)
    else:
        shutil.copyfile(new, there)
    for file in (there, *there.rglob("*")):
        if file.is_file():
            with file.open("r+b") as opened:
                os.fsync(opened.fileno())


def _replace(goal: Path, room: Path, owned: frozenset[str], back: ExitStack) -> None:
    """Replace what is at `goal`; let `back` undo each step if there is an error."""
    new, old = room / "new", room / "old"
    if goal.is_dir() and not new.is_dir():
        raise IsADirectoryError(errno.EISDIR, f"{goal} is a folder")
    if goal.is_dir():
        back.callback(_put_back, old, goal)
        os.rename(goal, old)
        for name in sorted(set(os.listdir(old)) - owned):
            if os.path.lexists(new / name):
                raise FileExistsError(errno.EEXIST, f"{goal / name} is not ours")
            back.callback(_put_back, new / name, old / name)
            os.rename(old / name, new / name)
        back.callback(_put_back, goal, new)
    elif goal.exists():
        try:
            os.link(goal, old)
        except OSError:  # not every disk has hard links
            shutil.copy2(goal, old)
        back.callback(_put_back, old, goal)
    else:
        back.callback(_put_back, goal, new)
    os.replace(new, goal)
    with suppress(OSError):  # Windows cannot wait for a folder
        _sync_folder(goal.parent)


def _put_back(now: Path, before: Path) -> None:
    """Undo a rename, if it was done."""
    with suppress(FileNotFoundError):
        os.replace(now, before)


def _sync_folder(folder: Path) -> None:
    """Wait until the names in a folder are on the disk."""
    opened = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)
