"""Names that are no longer than Blender keeps them: it would cut off their ends."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import bpy


def name_that_fits(name: str, ending: str) -> str:
    """Return a name and the whole of what is added to it, with less of a long name."""
    (found,) = shortened_names(
        lambda kept: [f"{kept} {ending}"], name, "", longest_name()
    )
    return found.strip()


def carrier_name(source: str) -> str:
    """Return the name of the mesh object that has the parts of another object."""
    return name_that_fits(source, "parts")


def longest_name() -> int:
    """Return the bytes that Blender keeps of a name: 4.2 keeps 63, and 5.2 255."""
    # Names end with a zero.
    return int(bpy.types.Object.bl_rna.properties["name"].length_max) - 1


def shortened_names(
    fill: Callable[[str], list[str]], name: str, ending: str, longest: int
) -> list[str]:
    """Return filled names with as much of a name as they have room for.

    Parameters
    ----------
    fill : callable
        Makes names that have a given name in them.
    name : str
        The name, of which less is left.
    ending : str
        What stays behind what is left of it.
    longest : int
        The bytes that there is room for.
    """
    names = fill(name + ending)
    while name and (excess := most_bytes(names) - longest) > 0:
        name = name.encode()[:-excess].decode(errors="ignore")
        names = fill(name + ending)
    return names


def most_bytes(names: Sequence[str]) -> int:
    """Return the bytes of the longest name."""
    return max((len(name.encode()) for name in names), default=0)
