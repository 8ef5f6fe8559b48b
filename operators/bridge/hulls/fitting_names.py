"""Names of hulls that are no longer than Blender keeps them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import bpy

from ....core.errors import DecompositionError
from ....core.parameters.hull_names import hull_names
from ..stored.long_names import longest_name, most_bytes, shortened_names
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
    longest = longest_name()
    names = hull_names(naming, template, obj.name, kinds)
    excess = most_bytes(names) - longest
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
        shortened = shortened_names(fill, obj.name, ending, longest)
        if taken.isdisjoint(shortened):
            return shortened
    return shortened_names(fill, obj.name, "", longest)
