"""Rename or recolor a part, with its vertex group, its material and its entry."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy

from ..mesh.points import is_cloud
from ..stored.identity import Identity
from ..stored.names import HULL_TAG, OVERLAY
from ..stored.record import change_part, record_of
from ..stored.restore import read_restore, sharers, write_restore
from ..stored.versions import identities_of
from ..views.face_sets_and_colors import show_colors
from .kept_materials import is_overlaid
from .materials import color_of, discard_unused, own_material, part_slots
from .palette import Color


def rename_part(obj: bpy.types.Object, number: int, name: str) -> str:
    """Rename a part of an object, unless the name is empty or taken.

    Returns
    -------
    str
        The name of the part afterwards. Blender may add a number to the name asked for.
    """
    identities, restore = identities_of(record_of(obj)), read_restore(obj.data)
    part = next((each for each in identities if each.number == number), None)
    if restore is None or part is None:
        return name
    taken = {each.name for each in identities if each != part}
    if name == part.name or not name or name in taken:
        return part.name
    group = obj.type == "MESH" and obj.vertex_groups.get(part.name)
    if group and part.name in restore.groups:
        group.name = name
        name = group.name  # with a number if the name is taken
        groups = [name if each == part.name else each for each in restore.groups]
        write_restore(obj.data, replace(restore, groups=groups))
    _change(obj, replace(part, name=name, color=color_of_part(obj, number)))
    return name


def color_of_part(obj: bpy.types.Object, number: int) -> Color:
    """Return the color of a part: that of its material, else as noted."""
    if not is_cloud(obj):
        slots = part_slots(obj.data).get(number)
        if slots:
            return color_of(obj.data.materials[slots[0]])
    for each in identities_of(record_of(obj)):
        if each.number == number:
            return each.color
    return 0.0, 0.0, 0.0


def recolor_part(obj: bpy.types.Object, number: int, color: Color) -> None:
    """Give a part of an object a color, on all that shows it; other objects stay."""
    for each in identities_of(record_of(obj)):
        if each.number == number:
            _change(obj, replace(each, color=color))
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
        kept, key = obj.data[OVERLAY], str(number)
        return (kept if key in kept else None), key
    slots = [] if is_cloud(obj) else part_slots(obj.data).get(number, [])
    return (obj.data.materials, slots[0]) if slots else (None, 0)


def _give_hulls(
    obj: bpy.types.Object, before: bpy.types.Material, material: bpy.types.Material
) -> None:
    """Give the hulls of a part its material, in place of the one before."""
    for child in obj.children if before != material else ():
        if HULL_TAG in child and before in child.data.materials[:]:
            child.data.materials[0] = material
            child.color = material.diffuse_color
    if before != material:
        discard_unused([before])
