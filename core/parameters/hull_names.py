"""Names of hulls, as game engines expect them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..errors import DecompositionError

# Unreal tells collision shapes by these; it has no cylinders.
_UNREAL = {"HULL": "UCX", "BOX": "UBX", "SPHERE": "USP", "CAPSULE": "UCP"}


@dataclass(frozen=True)
class Naming:
    """A way to name hulls; `template` is empty where the user gives it."""

    identifier: str
    label: str
    help: str
    template: str


NAMINGS = (
    Naming("PLAIN", "Plain", "Like Name hull 01", "{name} hull {n:02d}"),
    Naming(
        "UNREAL",
        "Unreal",
        "Like UCX_Name_01, with UBX for boxes, USP for spheres and UCP for capsules",
        "{prefix}_{name}_{n:02d}",
    ),
    Naming(
        "UNITY",
        "Unity",
        "Like Name_collider_01; Unity has no names of its own for colliders",
        "{name}_collider_{n:02d}",
    ),
    Naming(
        "GODOT",
        "Godot",
        "Like Name_01-convcolonly, which Godot's importer makes a convex shape of",
        "{name}_{n:02d}-convcolonly",
    ),
    Naming("TEMPLATE", "By Template", "As Template says", ""),
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
        For 'TEMPLATE', in the syntax of `str.format`.
    name : str
        Of the object.
    kinds : sequence of str
        Shape of each hull.

    Raises
    ------
    DecompositionError
        If the template cannot be filled in, or gives hulls the same name.
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
