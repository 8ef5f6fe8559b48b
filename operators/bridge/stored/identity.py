"""The number and name of a part, which stay when other parts are edited."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import bpy


@dataclass(frozen=True)
class Identity:
    """The number and name of a part; its place among the parts may change.

    Attributes
    ----------
    number : int
        Chooses its color; counted from 0.
    name : str
        Of its vertex group, material and entry in the record.
    """

    number: int
    name: str


def part_name(number: int) -> str:
    """Return the name of a part, counted from 0, as the user sees it."""
    return f"Part {number + 1:02d}"


def usual_identities(n_parts: int) -> tuple[Identity, ...]:
    """Return the identities of parts that were never edited."""
    return tuple(Identity(number, part_name(number)) for number in range(n_parts))


def identities_after(
    before: Sequence[Identity], former: Sequence[int], mirrored: Mapping[int, int]
) -> list[Identity]:
    """Return who the parts are after an edit.

    Parameters
    ----------
    before : sequence of Identity
        Of the K parts before the edit.
    former : sequence of int
        For each part, its place in `before`, or K and more if it is new. New parts get
        the lowest free numbers.
    mirrored : mapping of int to int
        New parts that are mirror images, and the parts that they mirror. They get the
        name of the other side.

    Returns
    -------
    list of Identity
        One for each of `former`.
    """
    found = {label: before[label] for label in former if label < len(before)}
    gone = {each.name: each for each in before if each not in found.values()}
    names = {
        image: bpy.utils.flip_name(found[label].name)
        for image, label in mirrored.items()
    }
    # A mirror image takes the place of the part that had its name.
    found |= {label: gone[name] for label, name in names.items() if name in gone}
    taken = {each.number for each in found.values()}
    for label in former:
        if label not in found:
            free = next(n for n in range(len(taken) + 1) if n not in taken)
            taken.add(free)
            found[label] = Identity(free, names.get(label) or part_name(free))
    return [found[label] for label in former]


def with_sides(
    identities: Sequence[Identity], sources: Iterable[int], side: str
) -> tuple[Identity, ...]:
    """Return identities; `sources` get the ending of a side, "L" or "R".

    A name that has such an ending already stays.
    """
    named = list(identities)
    for label in sources:
        name = named[label].name
        if bpy.utils.flip_name(name) == name:
            named[label] = Identity(named[label].number, f"{name}.{side}")
    return tuple(named)
