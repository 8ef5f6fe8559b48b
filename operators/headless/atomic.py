"""Files that are written whole or not at all, and why writing failed."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...core.errors import DecompositionError


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give the path of a new file beside `path`; rename it to `path` at the end.

    If the block raises, the new file is removed and `path` stays as it was. If `path`
    is a link, the file that it points to is replaced.
    """
    path = path.resolve()
    handle, name = tempfile.mkstemp(prefix=".wcd-", suffix=path.suffix, dir=path.parent)
    os.close(handle)
    unfinished = Path(name)
    unfinished.unlink()  # some exporters ask before they overwrite
    try:
        yield unfinished
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


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
        reason = getattr(error, "strerror", None) or str(error)
        reason = reason.strip().splitlines()[-1].removeprefix("Error: ")
        raise DecompositionError(f"{path} cannot be {action} ({reason}).") from error
