"""Names that are legal and distinct in a file, whatever objects are called."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

import bpy

from ...bridge.hulls.listed import is_hull
from ..formats import CONTROL_CHARACTERS

# What a name may not have in it, by format.
_ILLEGAL = {
    # A name ends at a space there.
    "obj": re.compile(rf"[{CONTROL_CHARACTERS}\s]"),
    # Simulators put names into paths and into other files.
    "xml": re.compile(rf"[{CONTROL_CHARACTERS}\\/\"'<>&]"),
    # Before USD 24.3, identifiers are ASCII.
    "usd": re.compile(r"[^A-Za-z0-9_]"),
}
_NAMELESS = "unnamed"


def legal_names(
    names: Sequence[str], form: str, reserved: Iterable[str] = ()
) -> list[str]:
    """Return a legal name for each name, all different.

    Characters that are not legal become underscores. Where this makes names equal, all
    but the first get a number: "A b" and "A_b" become "A_b" and "A_b_2". Names that
    are legal and different stay as they are. `form` is the format: obj, xml or usd. No
    name becomes one that is `reserved`.
    """
    legal = [_legal(name, form) for name in names]
    # Names that stay as they are come first: they keep their name.
    kept = {name for name, old in zip(legal, names, strict=True) if name == old}
    taken = set(reserved)
    numbers: dict[str, int] = {}  # the next one to try, by name
    found = []
    for name, old in zip(legal, names, strict=True):
        free = name
        while free in taken or (free in kept and free != old):
            number = numbers.get(name, 2)
            free, numbers[name] = f"{name}_{number}", number + 1
        taken.add(free)
        found.append(free)
    return found


def names_of_objects(form: str) -> dict[str, str]:
    """Return the legal name of each object that is no hull, by its name."""
    names = [obj.name for obj in bpy.data.objects if not is_hull(obj)]
    return dict(zip(names, legal_names(names, form), strict=True))


def names_of_hulls(
    hulls: Sequence[bpy.types.Object],
    form: str,
    owners: Mapping[str, str] | None = None,
) -> list[str]:
    """Return a legal name for each hull: the legal name of its object is in it.

    `owners` has the legal names of the objects that hulls are children of; by default
    they are those of `names_of_objects`.
    """
    owners = owners or names_of_objects(form)
    own = [
        hull.name.replace(hull.parent.name, owners[hull.parent.name], 1)
        for hull in hulls
    ]
    return legal_names(own, form)


def hulls_by_owner(
    hulls: Sequence[bpy.types.Object],
) -> dict[bpy.types.Object, list[bpy.types.Object]]:
    """Return the hulls of each object, in their order; they are its children."""
    owned: dict[bpy.types.Object, list[bpy.types.Object]] = {}
    for hull in hulls:
        owned.setdefault(hull.parent, []).append(hull)
    return owned


def _legal(name: str, form: str) -> str:
    """Return a legal name."""
    legal = _ILLEGAL[form].sub("_", name).strip() or _NAMELESS
    return f"_{legal}" if form == "usd" and legal[0].isdigit() else legal
