"""Files of text: their lines, the mark they may begin with, and counts in them."""

from __future__ import annotations

from codecs import BOM_UTF8
from collections.abc import Iterator
from pathlib import Path

# No file has as many rows as a number with more digits; Python refuses thousands.
MOST_DIGITS = 18


def lines_of(path: Path) -> Iterator[str]:
    """Yield the lines of a text file, without comments, spaces around and blank ones.

    A byte order mark counts for nothing, and lines may end as on old Macs.
    """
    lines = path.read_bytes().removeprefix(BOM_UTF8).splitlines()
    texts = (line.partition(b"#")[0].strip().decode("latin-1") for line in lines)
    yield from filter(None, texts)


def whole_number(text: str) -> int | None:
    """Return the count that a text states, None if it is no count.

    Parameters
    ----------
    text : str
        Up to 18 digits from 0 to 9; spaces around them do not matter.
    """
    digits = text.strip()
    if not (digits.isascii() and digits.isdigit() and len(digits) <= MOST_DIGITS):
        return None
    return int(digits)
