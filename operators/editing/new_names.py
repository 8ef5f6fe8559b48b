"""New names for many parts at once: numbered, replaced or typed.

A pair of mirror images, "Ear.L" and "Ear.R", has one name to edit: "Ear".
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from ...core.errors import DecompositionError

_SIDES = (".L", ".R")
_NUMBER = re.compile("#+")


class EditableName(NamedTuple):
    """A name to edit, of one part or of a pair.

    Attributes
    ----------
    base : str
        The name, of a pair without the side.
    endings : dict of int to str
        From the places of its parts among all names to what follows the base.
    """

    base: str
    endings: dict[int, str]


def editable(names: Sequence[str], chosen: Iterable[int]) -> list[EditableName]:
    """Return the names to edit of the parts at chosen places, and of their partners."""
    places = {name: place for place, name in enumerate(names)}
    found: dict[int, EditableName] = {}
    for place in chosen:
        base, side = names[place][:-2], names[place][-2:]
        both = [places.get(base + each) for each in _SIDES]
        if base and side in _SIDES and None not in both:
            endings = {places[base + each]: each for each in _SIDES}
        else:
            base, endings = names[place], {place: ""}
        found[min(endings)] = EditableName(base, endings)
    return [found[first] for first in sorted(found)]


def with_bases(rows: Sequence[EditableName], bases: Iterable[str]) -> dict[int, str]:
    """Return the new names, by place, if these are the new bases."""
    return {
        place: base.strip() + ending
        for row, base in zip(rows, bases, strict=True)
        for place, ending in row.endings.items()
    }


def numbered(rows: Sequence[EditableName], pattern: str) -> list[str]:
    """Return a pattern with the number of each row, from 1, in place of its "#".

    Raises
    ------
    DecompositionError
        If several rows would get the same name.
    """
    if len(rows) > 1 and "#" not in pattern:
        raise DecompositionError(
            f'"{pattern}" has no place for a number; put # there, or ## for 01, 02…'
        )
    return [
        _NUMBER.sub(lambda mark, n=n: f"{n:0{len(mark[0])}d}", pattern)  # type: ignore[misc]
        for n in range(1, len(rows) + 1)
    ]


def replaced(rows: Sequence[EditableName], find: str, replace: str) -> list[str]:
    """Return the bases with one text replaced by another."""
    return [row.base.replace(find, replace) if find else row.base for row in rows]
