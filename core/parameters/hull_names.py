"""Names hulls as game engines expect it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..errors import DecompositionError

# Prefixes by which Unreal recognizes collision shapes. It has none for cylinders.
_UNREAL = {"HULL": "UCX", "BOX": "UBX", "SPHERE": "USP", "CAPSULE": "UCP"}


@dataclass(frozen=True)
class Naming:
    """A way to name hulls.

    Attributes
    ----------
    identifier, label, help : str
        As for a `Choice`.
    template : str
        Pattern of the names in the syntax of `str.format`; empty if the user gives it.
    """

    identifier: str
    label: str
    help: str
    template: str


NAMINGS = (
    Naming("PLAIN", "Plain", "For example Name hull 01", "{name} hull {n:02d}"),
    Naming(
        "UNREAL",
        "Unreal",
        "For example UCX_Name_01; names of boxes begin with UBX, of spheres with USP,"
        " of capsules with UCP",
        "{prefix}_{name}_{n:02d}",
    ),
    Naming(
        "UNITY",
        "Unity",
        "For example Name_collider_01; Unity prescribes no names for colliders",
        "{name}_collider_{n:02d}",
    ),
    Naming(
        "GODOT",
        "Godot",
        "For example Name_01-convcolonly; Godot imports it as a convex collision shape",
        "{name}_{n:02d}-convcolonly",
    ),
    Naming("TEMPLATE", "By Template", "The pattern in Template", ""),
)


def hull_names(
    naming: str, template: str, name: str, kinds: Sequence[str]
) -> list[str]:
    """Return the names of an object's hulls.

    Parameters
    ----------
    naming : str
        Identifier of one of `NAMINGS`.
    template : str
        Pattern in the syntax of `str.format`, used if `naming` is 'TEMPLATE'.
    name : str
        Name of the object.
    kinds : sequence of str
        Kind of each hull: 'HULL', 'BOX', 'SPHERE', 'CYLINDER' or 'CAPSULE'.

    Returns
    -------
    list of str
        One name for each hull, all different.

    Raises
    ------
    DecompositionError
        If the template cannot be filled in, or gives two hulls the same name.
    """
    chosen = next(n.template for n in NAMINGS if n.identifier == naming) or template
    try:
        names = [
            chosen.format(
                name=name, n=n, kind=kind.lower(), prefix=_UNREAL.get(kind, "UCX")
            )
            for n, kind in enumerate(kinds, start=1)
        ]
    except (KeyError, IndexError, ValueError, AttributeError, TypeError) as error:
        raise DecompositionError(
            f"Template {template!r} cannot be filled in; write it like"
            " {name}_{n:02d}, with {name}, {n}, {kind} and {prefix} only."
        ) from error
    if len(set(names)) < len(names):
        raise DecompositionError(
            f"Template {template!r} gives all hulls one name; put {{n}} in it."
        )
    return names
