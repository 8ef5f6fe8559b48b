"""Remove from an object what `write` wrote to it, and nothing else."""

from __future__ import annotations

import bpy
import numpy as np

from ..mesh.attributes import IntArray
from ..mesh.layers import EditModeLayers, ObjectModeLayers, layers_of
from ..stored.names import FACE_SET_LAYER, FACE_SETS, LAYERS, MATERIAL_LAYER, PART_LAYER
from ..stored.record import check_records, forget_parts, forget_result
from ..stored.restore import Restore, read_restore, sharers, write_restore
from .materials import discard_unused, is_ours, name_of, our_materials, part_slots
from .rows import erase_rows


def clear(obj: bpy.types.Object) -> None:
    """Remove everything of ours from an object, its mesh and the file."""
    check_records(obj)
    erase_parts(obj)
    discard_unused(our_materials())  # also where the user removed their slots
    forget_result(obj)


def erase_parts(obj: bpy.types.Object) -> list[bpy.types.Material]:
    """Remove the parts from a mesh; return the materials taken out of its slots.

    Changes that the user made since stay: faces with another material keep it, and
    renamed groups and materials are not removed.
    """
    mesh = obj.data
    restore = read_restore(mesh)
    if restore is None:
        return []
    _erase_groups(obj, restore)
    layers = layers_of(obj)
    indices = _indices_without_ours(mesh, restore, layers)
    materials = _erase_slots(obj, restore)
    layers.set_material_indices(indices)
    _restore_face_sets(layers)
    for name in LAYERS:
        layers.remove(name)
    layers.finish()
    write_restore(mesh, None)
    for sharer in sharers(obj):
        forget_parts(sharer)
        erase_rows(sharer)
    return materials


def bare_materials(
    obj: bpy.types.Object, restore: Restore | None
) -> tuple[IntArray | None, list[str]]:
    """Return the material index of each face, and the names of the user's materials.

    Both are as they would be without our slots.
    """
    mesh, layers = obj.data, layers_of(obj)
    if restore is None:
        return layers.material_indices(), _names_without(mesh, [])
    indices = _indices_without_ours(mesh, restore, layers)
    return indices, _names_without(mesh, _our_slots(mesh, restore))


def _erase_groups(obj: bpy.types.Object, restore: Restore) -> None:
    """Remove our vertex groups and make the user's group active again."""
    groups = obj.vertex_groups
    active = groups.active.name if groups.active else ""
    for name in {*restore.groups, *_joined_groups(obj, restore)}:
        if name in groups:
            groups.remove(groups[name])
    if active not in groups:
        active = restore.active_group
    if active in groups:
        groups.active_index = groups[active].index


def _joined_groups(obj: bpy.types.Object, restore: Restore) -> set[str]:
    """Return the names of groups of ours that came with objects joined to this one."""
    if restore.user_groups is None or not getattr(obj.data, "polygons", None):
        return set()
    return {
        name_of(obj.data.materials[slot])
        for slots in part_slots(obj.data).values()
        for slot in slots
    } - set(restore.user_groups)


def _restore_face_sets(layers: ObjectModeLayers | EditModeLayers) -> None:
    """Restore the former face sets, unless the user changed ours since."""
    before, parts = layers.faces(FACE_SET_LAYER), layers.faces(PART_LAYER)
    now = layers.faces(FACE_SETS)
    if before is None or now is None or parts is None or (now != parts + 1).any():
        return
    if before.any():
        layers.set_faces(FACE_SETS, before)
    else:
        layers.remove(FACE_SETS)


def _indices_without_ours(
    mesh: bpy.types.Mesh, restore: Restore, layers: ObjectModeLayers | EditModeLayers
) -> IntArray | None:
    """Return the material index of each face after our slots are removed."""
    if not getattr(mesh, "polygons", None):  # points
        return None
    now = layers.material_indices()
    if now is None:
        now = np.zeros(len(mesh.polygons), dtype=np.int32)
    ours = _our_slots(mesh, restore)
    before = layers.faces(MATERIAL_LAYER)
    if before is None:
        before = np.full_like(now, restore.material_index or 0)
    indices = np.where(
        np.isin(now, ours),
        _moved(before, restore.slots, _names_without(mesh, ours)),
        now - np.searchsorted(ours, now),
    ).astype(np.int32)
    if not restore.had_material_index and not indices.any():
        return None
    return indices


def _our_slots(mesh: bpy.types.Mesh, restore: Restore) -> list[int]:
    """Return the indices of the slots that hold our materials."""
    return [
        index
        for index, material in enumerate(mesh.materials)
        if is_ours(material) and material.name not in restore.slots
    ]


def _names_without(mesh: bpy.types.Mesh, ours: list[int]) -> list[str]:
    """Return the names of the materials in the user's slots, '' for none."""
    return [
        material.name if material else ""
        for index, material in enumerate(mesh.materials)
        if index not in ours
    ]


def _moved(indices: IntArray, slots: list[str], remaining: list[str]) -> IntArray:
    """Return indices of former slots as indices of the slots that will remain.

    The user may have moved, removed or renamed materials since.
    """
    moved = indices.copy()
    place = 0  # Blender gives the faces of a removed slot to the slot before
    for former, name in enumerate(slots):
        there = remaining[former] if former < len(remaining) else None
        renamed = name not in remaining and there is not None and there not in slots
        if there == name or renamed:
            place = former
        elif name in remaining:
            place = remaining.index(name)
        moved[indices == former] = place
    return moved


def _erase_slots(obj: bpy.types.Object, restore: Restore) -> list[bpy.types.Material]:
    """Remove the slots that hold our materials; return the materials."""
    mesh = obj.data
    ours = _our_slots(mesh, restore)
    if not ours:
        return []
    active = obj.active_material_index
    # Removing a slot of the mesh does not move the objects' own materials.
    linked = [
        (sharer, [_object_link(slot) for slot in sharer.material_slots])
        for sharer in sharers(obj)
    ]
    materials = [mesh.materials[i] for i in ours]
    if len(ours) == len(mesh.materials):
        mesh.materials.clear()  # `pop` would leave the objects an empty slot
    else:
        for index in reversed(ours):
            mesh.materials.pop(index=index)
    for sharer, links in linked:
        kept = [link for i, link in enumerate(links) if i not in ours]
        for slot, link in zip(sharer.material_slots, kept, strict=False):
            _set_object_link(slot, link)
    if mesh.materials:
        active = (
            restore.active_slot
            if active in ours
            else active - sum(i < active for i in ours)
        )
        obj.active_material_index = min(active, len(mesh.materials) - 1)
    return materials


def _object_link(
    slot: bpy.types.MaterialSlot,
) -> tuple[bool, bpy.types.Material | None]:
    """Return whether a slot's material is the object's own, and that material."""
    own = slot.link == "OBJECT"
    return own, slot.material if own else None


def _set_object_link(
    slot: bpy.types.MaterialSlot, link: tuple[bool, bpy.types.Material | None]
) -> None:
    """Give a slot what `_object_link` returned."""
    own, material = link
    if (slot.link == "OBJECT") != own:
        slot.link = "OBJECT" if own else "DATA"
    if own and slot.material != material:
        slot.material = material
