"""Names of hulls that are no longer than Blender keeps them."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ....core.errors import DecompositionError
from ....core.parameters.hull_names import hull_names


def names_that_fit(
    obj: bpy.types.Object, naming: str, template: str, kinds: Sequence[str]
) -> list[str]:
    """Return the names of an object's hulls; too long ones have less of its name.

    Blender would cut off their ends, where the numbers are.

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
    # Names end with a zero. Blender 4.2 keeps 63 bytes, and 5.2 255.
    longest = bpy.types.Object.bl_rna.properties["name"].length_max - 1
    name, names = obj.name, hull_names(naming, template, obj.name, kinds)
    while name and (excess := max(len(each.encode()) for each in names) - longest) > 0:
        if naming == "UNREAL":
            raise DecompositionError(
                f"The names of hulls would have {longest + excess} bytes, of which"
                f" Blender keeps {longest}; shorten the name of the object by {excess},"
                " or choose another Naming."
            )
        name = name.encode()[:-excess].decode(errors="ignore")
        names = hull_names(naming, template, name, kinds)
    return names
