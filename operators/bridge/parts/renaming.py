"""Rename or recolor parts, with their vertex groups, materials and entries."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import bpy

from ....core.errors import DecompositionError
from ..hulls.listed import hulls_of
from ..hulls.looks import look_like, look_of
from ..refusals import library_refusal, name_refusal
from ..stored.identity import Color, Identity
from ..stored.names import KEPT_MATERIALS
from ..stored.noted_parts import identities_of
from ..stored.record import change_part, record_of
from ..stored.restore import read_restore, sharers, write_restore
from ..stored.users_groups import users_groups
from ..views.face_sets_and_colors import show_colors
from ..watching import REPLACED
from .figures import JOINED
from .materials import color_of, discard_unused, own_material
from .palette import free_color
from .part_materials import is_overlaid, mark_group, part_slots

# The default of the colors of parts, which none has: Blender has one for all of them.
UNSET: Color = (-1.0, -1.0, -1.0)
# The latest name that was typed and not taken: the object, the number of the part and
# the name. It is not in Blender's data, because undo would bring it back.
refused: tuple[int, int, str] | None = None


def rename_part(
    obj: bpy.types.Object, number: int, name: str
) -> tuple[str, str | None]:
    """Rename a part of an object, if it can have the name.

    Returns
    -------
    name : str
        The name of the part afterwards. Blender may add a number to the name asked for.
    reason : str or None
        Why it is not the name asked for.
    """
    part, restore = _noted(obj, number), read_restore(obj.data)
    if restore is None or part is None or name == part.name:
        return name, None
    reason = _refusal(obj, part, name)
    if reason:
        return part.name, reason
    group = obj.type == "MESH" and obj.vertex_groups.get(part.name)
    ours = part.name in restore.groups and part.name not in users_groups(obj, restore)
    if group and ours:
        group.name = name
        if group.name != name:
            reason = _clash(name, group.name)
        name = group.name  # with a number if the name is taken
        groups = [name if each == part.name else each for each in restore.groups]
        write_restore(obj.data, replace(restore, groups=groups))
    _change(obj, replace(part, name=name, color=color_of_part(obj, number)))
    if is_overlaid(obj):
        mark_group(obj, number, name)
    return name, reason


def rename_parts(obj: bpy.types.Object, names: Mapping[int, str]) -> list[str]:
    """Rename several parts, by number; they may take each other's names.

    Return a sentence for each part whose name Blender changed further.

    Raises
    ------
    DecompositionError
        If a part cannot have its name, or was joined to the object and is not listed
        yet. Then all parts keep their names.
    """
    before = {each.number: each.name for each in identities_of(record_of(obj))}
    if not names.keys() <= before.keys():
        raise DecompositionError(JOINED)
    after = {**before, **names}
    for number, name in names.items():
        others = [other for key, other in after.items() if key != number]
        reason = name_refusal(name, before[number], others)
        if reason:
            rest = " No part was renamed." if len(names) > 1 else ""
            raise DecompositionError(f"{reason}.{rest}")
    # First out of each other's way.
    for number, name in names.items():
        if name != before[number] and name in before.values():
            rename_part(obj, number, f"wcd {number}")
    found = [rename_part(obj, number, name) for number, name in names.items()]
    return [reason for _, reason in found if reason]


def noted_refusal(obj: bpy.types.Object, number: int) -> str | None:
    """Return why a part has not the name that was typed latest, while that holds."""
    if refused is None or refused[:2] != (obj.session_uid, number):
        return None
    name, part = refused[2], _noted(obj, number)
    if part is None or part.name == name:
        return None
    taken = obj.type == "MESH" and name in obj.vertex_groups
    clash = _clash(name, part.name) if taken else None
    return _refusal(obj, part, name) or clash


def forget_refused(*_: object) -> None:
    """Forget the name that was not taken. Blender passes arguments to handlers."""
    global refused
    refused = None


stop = forget_refused  # when the extension goes
HANDLERS = dict.fromkeys(REPLACED, forget_refused)


def _noted(obj: bpy.types.Object, number: int) -> Identity | None:
    """Return who a part is by the record of an object, None if it is not there."""
    identities = identities_of(record_of(obj))
    return next((each for each in identities if each.number == number), None)


def _refusal(obj: bpy.types.Object, part: Identity, name: str) -> str | None:
    """Return why a part of an object cannot have a name."""
    taken = {each.name for each in identities_of(record_of(obj)) if each != part}
    return library_refusal(obj) or name_refusal(name, part.name, taken)


def _clash(name: str, instead: str) -> str:
    """Return that a name is taken by a group, and which name the part has instead."""
    return f"Another vertex group is called {name}; this one is {instead}"


def color_of_part(obj: bpy.types.Object, number: int) -> Color:
    """Return the color of a part: that of its material, else as noted."""
    slots = part_slots(obj).get(number)
    if slots:
        return color_of(obj.data.materials[slots[0]])
    part = _noted(obj, number)
    return part.color if part else (0.0, 0.0, 0.0)


def recolor_part(obj: bpy.types.Object, number: int, color: Color) -> None:
    """Give a part of an object a color, on all that shows it; other objects stay.

    Where the user resets the color to its default, it is the first of the palette that
    no other part has. Parts of a mesh that is linked from a library keep theirs.
    """
    part = None if library_refusal(obj) else _noted(obj, number)
    if part:
        if min(color) < 0.0:
            others = (row.number for row in obj.wcd_parts if row.number != number)
            color = free_color(color_of_part(obj, each) for each in others)
        _change(obj, replace(part, color=color))
        show_colors(obj)


def _change(obj: bpy.types.Object, identity: Identity) -> None:
    """Note a new name or color, and give it to the material in the part's slot."""
    change = {"name": identity.name, "color": list(identity.color)}
    holder, place = _home(obj, identity.number)
    if holder is not None:
        before = holder[place]
        holder[place] = material = own_material(before, identity)
        _give_hulls(obj, before, material)
        change["material"] = material.name
    for sharer in sharers(obj):
        change_part(sharer, identity.number, change)
        for row in sharer.wcd_parts:
            if row.number == identity.number and row.name != identity.name:
                row.name = identity.name


def _home(obj: bpy.types.Object, number: int) -> tuple[Any, int | str]:
    """Return what holds the material of a part, and its place there; None for none."""
    if is_overlaid(obj):
        kept, key = obj.data[KEPT_MATERIALS], str(number)
        return (kept if key in kept else None), key
    slots = part_slots(obj).get(number)
    return (obj.data.materials, slots[0]) if slots else (None, 0)


def _give_hulls(
    obj: bpy.types.Object, before: bpy.types.Material, material: bpy.types.Material
) -> None:
    """Give the hulls of a part its material, in place of the one before."""
    for hull in hulls_of(obj) if before != material else ():
        slots = hull.data.materials
        if before in slots[:]:
            slots[slots[:].index(before)] = material
            hull.color = (*material.diffuse_color[:3], hull.color[3])
            look_like([hull], look_of(hull))
    if before != material:
        discard_unused([before])
