"""Who a part is: its number, name and color, which stay when other parts change."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from .names import LONGEST_NAME

# Linear red, green and blue, each in 0…1.
Color: TypeAlias = tuple[float, float, float]

# Blender adds a number to a name that is taken: "Ear.001". Any digits behind a last dot
# are such a number to it: where "Leg.1" is taken, comes "Leg.002".
_NUMBERED = re.compile(r"\.\d+$")
# Bytes that are left of the longest name with a number of three digits.
_ROOM = LONGEST_NAME - len(".001")
_USUAL = re.compile(r"Part \d{2,}$")


@dataclass(frozen=True)
class Identity:
    """Who a part is; its place among the parts may change.

    Attributes
    ----------
    number : int
        Value of the attribute `wcd_part` on its faces, from 0. No other part of the
        object has it.
    name : str
        Of its vertex group and its entry in the record; its material may have a number
        behind it.
    color : Color
    """

    number: int
    name: str
    color: Color


def rgb(channels: Sequence[float]) -> Color:
    """Return the first three channels of a color."""
    red, green, blue = channels[:3]
    return red, green, blue


def part_name(number: int) -> str:
    """Return the name of a part, counted from 0, as the user sees it."""
    return f"Part {number + 1:02d}"


def plain_name(name: str) -> str:
    """Return a name without the number that Blender adds to a name that is taken."""
    return _NUMBERED.sub("", name)


def has_name(given: str, name: str) -> bool:
    """Return whether Blender may have made a name of the one asked for.

    Blender adds a number where a name is taken. Before 5.0, it cuts names of data so
    that they have room for it: to 59 bytes, or 58 for numbers above 999, and fewer
    where a letter has several bytes.
    """
    plain, asked = plain_name(given), plain_name(name)
    if plain == asked:
        return True
    letters = asked.encode()
    if len(letters) <= _ROOM:
        return False
    cut = (letters[:n].decode(errors="ignore") for n in (_ROOM, _ROOM - 1))
    return plain in map(plain_name, cut)


def without_side(name: str) -> str:
    """Return a name without the ending of a side, ".L" or ".R"."""
    return name[:-2] if name.endswith((".L", ".R")) else name


def free_name(taken: Collection[str]) -> str:
    """Return the first of "Part 01", "Part 02"… that no part has, on either side."""
    used = {without_side(plain_name(name)) for name in taken}
    return next(
        name for n in range(len(taken) + 1) if (name := part_name(n)) not in used
    )


def unique_name(name: str, taken: Collection[str]) -> str:
    """Return a name that no other part has, near to the one wished for.

    Parts that nobody named get the next free number; others get one as Blender does.
    """
    if name not in taken:
        return name
    plain = plain_name(name)
    if _USUAL.match(without_side(plain)):
        return free_name(taken)
    numbered = (f"{plain}.{n:03d}" for n in range(1, len(taken) + 2))
    return next(each for each in numbered if each not in taken)
