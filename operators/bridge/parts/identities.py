"""Who the parts are after a run, an edit or a join: what stays, and what new ones get.

New parts get numbers, names and colors that no other part of the object has.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import bpy

from ..stored.identity import Color, Identity, free_name, unique_name
from .palette import free_color, partner_color


class Newcomers:
    """Makes identities for new parts, beside those that are there.

    Parameters
    ----------
    there : iterable of Identity
        Parts that stay.
    gone : iterable of Identity
        Parts that vanish; their numbers are not used again at once.
    """

    def __init__(
        self, there: Iterable[Identity], gone: Iterable[Identity] = ()
    ) -> None:
        self.known = list(there)
        self._numbers = {each.number for each in (*self.known, *gone)}
        self._next = 0

    def add(self, name: str | None = None, color: Color | None = None) -> Identity:
        """Return a new part, with this name and color or free ones."""
        taken = self._names()
        while self._next in self._numbers:
            self._next += 1
        self._numbers.add(self._next)
        used = [each.color for each in self.known]
        new = Identity(
            self._next,
            unique_name(name, taken) if name else free_name(taken),
            free_color(used) if color is None or color in used else color,
        )
        self.known.append(new)
        return new

    def add_pair(self) -> tuple[Identity, Identity]:
        """Return two new parts, the left one and its mirror image."""
        base = free_name(self._names())
        left = self.add(f"{base}.L")
        return left, self.add(f"{base}.R", partner_color(left.color))

    def add_image(self, source: Identity) -> Identity:
        """Return the mirror image of a part, named for the other side if it has one."""
        name = bpy.utils.flip_name(source.name)
        if name == source.name or name in self._names():
            return self.add(color=partner_color(source.color))
        return self.add(name, partner_color(source.color))

    def _names(self) -> set[str]:
        """Return the names that new parts must not have."""
        return {each.name for each in self.known}


def identities_of_run(
    former: Sequence[Identity | None],
    before: Iterable[Identity],
    pairs: Iterable[tuple[int, int]],
) -> tuple[Identity, ...]:
    """Return who the parts of a new run are.

    Parameters
    ----------
    former : sequence of Identity or None
        For each part, the one that it continues; None for a new part.
    before : iterable of Identity
        All parts that were there.
    pairs : iterable of (int, int)
        The left and the right part of each pair of mirror images.
    """
    found = list(former)
    newcomers = Newcomers((each for each in found if each is not None), before)
    of_left = dict(pairs)
    partners = of_left | {right: left for left, right in of_left.items()}
    for part, identity in enumerate(found):
        if identity is not None:
            continue
        partner = partners.get(part)
        if partner is None:
            found[part] = newcomers.add()
        elif (source := found[partner]) is not None:
            found[part] = newcomers.add_image(source)
        else:
            left = part if part in of_left else partner
            found[left], found[partners[left]] = newcomers.add_pair()
    return tuple(each for each in found if each is not None)


def identities_after(
    before: Sequence[Identity], former: Sequence[int], mirrored: Mapping[int, int]
) -> list[Identity]:
    """Return who the parts are after an edit.

    Parameters
    ----------
    before : sequence of Identity
        Of the K parts before the edit.
    former : sequence of int
        For each part, its place in `before`, or K and more if it is new.
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
    # A mirror image takes the place of the part that had its name.
    for image, source in mirrored.items():
        name = bpy.utils.flip_name(before[source].name)
        if name in gone:
            found[image] = gone[name]
    newcomers = Newcomers(found.values())
    for label in former:
        if label not in found and label in mirrored:
            found[label] = newcomers.add_image(before[mirrored[label]])
        elif label not in found:
            found[label] = newcomers.add()
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
            named[label] = replace(named[label], name=f"{name}.{side}")
    return tuple(named)
