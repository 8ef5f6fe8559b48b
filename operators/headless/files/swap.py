"""New files and folders take the place of old ones: all of them, or none."""

from __future__ import annotations

import errno
import os
import shutil
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path


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
    rooms: list[Path] = []
    back: list[tuple[Path, Path]] = []  # renames that undo what was done, oldest first
    try:
        for new, goal in moves:
            rooms.append(_room_for(new, goal))
        for (_, goal), room in zip(moves, rooms, strict=True):
            _replace(goal, room, owned, back)
    except BaseException:
        for now, before in reversed(back):
            with suppress(FileNotFoundError):  # it was not renamed yet
                os.replace(now, before)
        _remove(rooms)
        raise
    _remove(rooms)


def _room_for(new: Path, goal: Path) -> Path:
    """Make a folder beside the goal, on its disk, and bring the new one there."""
    room = Path(tempfile.mkdtemp(prefix=".wcd-", dir=goal.parent))
    there = room / "new"
    try:
        try:
            os.rename(new, there)
        except OSError as error:
            if error.errno != errno.EXDEV:
                raise
            _copy(new, there)
        if goal.exists():
            shutil.copymode(goal, there)
    except BaseException:
        _remove([room])
        raise
    return room


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


def _replace(
    goal: Path, room: Path, owned: frozenset[str], back: list[tuple[Path, Path]]
) -> None:
    """Replace what is at `goal`; note in `back` how each step is undone."""
    new, old = room / "new", room / "old"
    if goal.is_dir() and not new.is_dir():
        raise IsADirectoryError(errno.EISDIR, f"{goal} is a folder")
    if goal.is_dir():
        back.append((old, goal))
        os.rename(goal, old)
        for name in sorted(set(os.listdir(old)) - owned):
            if os.path.lexists(new / name):
                raise FileExistsError(errno.EEXIST, f"{goal / name} is not ours")
            back.append((new / name, old / name))
            os.rename(old / name, new / name)
        back.append((goal, new))
    elif goal.exists():
        try:
            os.link(goal, old)
        except OSError:  # not every disk has hard links
            shutil.copy2(goal, old)
        back.append((old, goal))
    else:
        back.append((goal, new))
    os.replace(new, goal)
    with suppress(OSError):  # Windows cannot wait for a folder
        _sync_folder(goal.parent)


def _sync_folder(folder: Path) -> None:
    """Wait until the names in a folder are on the disk."""
    opened = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)


def _remove(rooms: Sequence[Path]) -> None:
    """Remove the folders in which old and new waited."""
    for room in rooms:
        shutil.rmtree(room, ignore_errors=True)
