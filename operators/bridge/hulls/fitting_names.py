"""Names of hulls and of other objects that are no longer than Blender keeps them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import bpy

from ....core.errors import DecompositionError
from ....core.parameters.hull_names import hull_names
from .listed import hulls_of


def names_that_fit(
    obj: bpy.types.Object, naming: str, template: str, kinds: Sequence[str]
) -> list[str]:
    """Return the names of an object's hulls; too long ones have less of its name.

    Blender would cut off their ends, where the numbers are. If what is left of the name
    is that of other hulls, it gets a number.

    Parameters
    ----------
    obj : Object
    naming, template, kinds
        As `hull_names` takes them.

    Raises
    ------
    DecompositionError
        As `hull_names` does, or if Unreal needs a name that is too long: it finds the
        mesh of a hull by the whole of its name.
    """
    longest = _longest()
    names = hull_names(naming, template, obj.name, kinds)
    excess = _most_bytes(names) - longest
    if excess <= 0:
        return names
    if naming == "UNREAL":
        raise DecompositionError(
            f"The names of hulls would have {longest + excess} bytes, of which"
            f" Blender keeps {longest}; shorten the name of the object by {excess},"
            " or choose another Naming."
        )
    own = set(hulls_of(obj))
    taken = {each.name for each in bpy.data.objects if each not in own}
    fill = partial(hull_names, naming, template, kinds=kinds)
    for number in range(1, len(bpy.data.objects) + 1):
        ending = f" {number}" if number > 1 else ""
        shortened = _shortened(fill, obj.name, ending, longest)
        if taken.isdisjoint(shortened):
            return shortened
    return _shortened(fill, obj.name, "", longest)


def name_that_fits(name: str, ending: str) -> str:
    """Return a name and the whole of what is added to it, with less of a long name."""
    (found,) = _shortened(lambda kept: [f"{kept} {ending}"], name, "", _longest())
    return found.strip()


def _longest() -> int:
    """Return the bytes that Blender keeps of a name: 4.2 keeps 63, and 5.2 255."""
    # Names end with a zero.
    return int(bpy.types.Object.bl_rna.properties["name"].length_max) - 1


def _shortened(
    fill: Callable[[str], list[str]], name: str, ending: str, longest: int
) -> list[str]:
    """Return filled names with as much of a name as they have room for."""
    names = fill(name + ending)
    while name and (excess := _most_bytes(names) - longest) > 0:
        name = name.encode()[:-excess].decode(errors="ignore")
        names = fill(name + ending)
    return names


def _most_bytes(names: Sequence[str]) -> int:
    """Return the bytes of the longest name."""
    return max((len(name.encode()) for name in names), default=0)
