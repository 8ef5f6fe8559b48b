"""Names hulls as game engines expect it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from string import Formatter

from ..errors import DecompositionError
from .parameter import Choice

# Prefixes by which Unreal recognizes collision shapes. It has none for cylinders.
UNREAL_PREFIXES = {"HULL": "UCX", "BOX": "UBX", "SPHERE": "USP", "CAPSULE": "UCP"}
# Most characters that a template may add to the name of the object. Blender cuts names
# off after 255 bytes.
_LONGEST = 255
# No object has more hulls.
_MOST_NUMBERS = 10_000


@dataclass(frozen=True)
class Naming(Choice):
    """A way to name hulls.

    Attributes
    ----------
    template : str
        Pattern of the names in the syntax of `str.format`; empty if the user gives it.
    """

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
        If the template cannot be filled in, or names are too long or not different.
    """
    chosen = _template_of(naming, template)
    try:
        wide = _widest_field(chosen) > _LONGEST
        names = [
            _filled(chosen, name, n, kind)
            for n, kind in enumerate([] if wide else kinds, start=1)
        ]
    except (KeyError, IndexError, ValueError, AttributeError, TypeError) as error:
        raise DecompositionError(
            f"Template {template!r} cannot be filled in; write it like"
            " {name}_{n:02d}, with {name}, {n}, {kind} and {prefix} only."
        ) from error
    if wide or max(map(len, names), default=0) > _LONGEST + len(name):
        raise DecompositionError(
            f"Template {template!r} adds more than {_LONGEST} characters to a name;"
            " shorten it."
        )
    if len(set(names)) < len(names):
        raise DecompositionError(
            f"Template {template!r} gives all hulls one name; put {{n}} in it."
        )
    return names


def name_of_kind(
    naming: str, template: str, name: str, former: str, kinds: tuple[str, str]
) -> str:
    """Return the name of a hull that gets another kind; its number stays.

    Parameters
    ----------
    naming, template, name : str
        As for `hull_names`, which takes them.
    former : str
        Its name so far.
    kinds : tuple of two str
        Its kind so far, and the new one.

    Returns
    -------
    str
        The former name if `hull_names` does not give it.
    """
    chosen = _template_of(naming, template)
    for n in range(1, _MOST_NUMBERS):
        if _filled(chosen, name, n, kinds[0]) == former:
            return _filled(chosen, name, n, kinds[1])
    return former


def _template_of(naming: str, template: str) -> str:
    """Return the pattern of a naming, which may be the user's template."""
    return next(n.template for n in NAMINGS if n.identifier == naming) or template


def _filled(template: str, name: str, n: int, kind: str) -> str:
    """Return the name of a hull by a pattern; raise what `str.format` does."""
    prefix = UNREAL_PREFIXES.get(kind, "UCX")
    return template.format(name=name, n=n, kind=kind.lower(), prefix=prefix)


def _widest_field(template: str) -> int:
    """Return the largest number in the format specs of a template; 0 if none has any.

    Python would fill a name up to that width, whatever memory it takes. Raise
    ValueError if a field within a spec says what the width is.
    """
    specs = " ".join(spec or "" for _, _, spec, _ in Formatter().parse(template))
    if "{" in specs:
        raise ValueError(specs)
    return max(map(int, re.findall(r"\d+", specs)), default=0)
