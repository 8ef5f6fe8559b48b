"""Removes objects with all of theirs that nothing else uses."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from .parts.materials import discard_unused, is_ours


def discard(objects: Sequence[bpy.types.Object]) -> None:
    """Remove mesh objects, then the meshes and materials of ours without users."""
    meshes = {obj.data for obj in objects}
    worn = {material for mesh in meshes for material in mesh.materials}
    worn |= {slot.material for obj in objects for slot in obj.material_slots}
    materials = set(filter(is_ours, worn))
    for obj in objects:
        bpy.data.objects.remove(obj)
    for mesh in meshes:
        if mesh.users == 0:
            bpy.data.meshes.remove(mesh)
    discard_unused(materials)
