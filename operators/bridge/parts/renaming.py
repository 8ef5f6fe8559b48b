"""Rename a part, with its vertex group, its material and its entry in the record."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy

from ..mesh.points import is_cloud
from ..stored.identity import Identity
from ..stored.record import identities_of, record_of, share_result, write_record
from ..stored.restore import read_restore, write_restore
from .materials import discard_unused, is_ours, renamed_material


def rename_part(obj: bpy.types.Object, index: int, name: str) -> str:
    """Rename a part of an object, unless the name is empty or taken.

    Returns
    -------
    str
        The name of the part afterwards. Blender may add a number to the name asked for.
    """
    record, restore = record_of(obj), read_restore(obj.data)
    entries = record.get("parts", [])
    if restore is None or index >= len(entries):
        return name
    entry = entries[index]
    taken = {other["name"] for other in entries if other is not entry}
    if name == entry["name"] or not name or name in taken:
        return str(entry["name"])
    group = obj.type == "MESH" and obj.vertex_groups.get(entry["name"])
    if group:
        group.name = name
        name = group.name  # with a number if the name is taken
        groups = list(restore.groups)
        groups[groups.index(entry["name"])] = name
        write_restore(obj.data, replace(restore, groups=groups))
    entry["name"] = name
    _rename_material(obj, entry, replace(identities_of(record)[index], name=name))
    write_record(obj, record)
    _tell_sharers(obj, record, index, name)
    return name


def _tell_sharers(
    obj: bpy.types.Object, record: dict[str, Any], index: int, name: str
) -> None:
    """Note a part's new name on the other objects that have the mesh and its parts."""
    for other in bpy.data.objects:
        shares = other.data == obj.data and other != obj and other.is_editable
        if shares and index < len(other.wcd_parts):
            share_result(record, other)
            other.wcd_parts[index].name = name


def _rename_material(
    obj: bpy.types.Object, entry: dict[str, Any], identity: Identity
) -> None:
    """Put a material with the part's new name into the part's slot."""
    materials = obj.data.materials
    index = materials.find(entry["material"])
    if index < 0 or is_cloud(obj) or not is_ours(materials[index]):
        return
    before = materials[index]
    materials[index] = renamed_material(before, identity)
    entry["material"] = materials[index].name
    discard_unused([before])
