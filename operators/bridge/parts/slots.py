"""The material slots of parts: put in for a result, and taken out again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..mesh.attributes import IntArray
from ..mesh.layers import EditModeLayers, ObjectModeLayers, layers_of
from ..stored.names import KEPT_MATERIALS, MATERIAL_LAYER
from ..stored.restore import Restore, sharers
from .materials import is_ours


def put_in_slots(
    obj: bpy.types.Object,
    materials: Sequence[bpy.types.Material],
    rows: NDArray[np.integer],
) -> dict[str, Any]:
    """Put materials into slots after the user's, and give them to faces.

    Parameters
    ----------
    obj : bpy.types.Object
    materials : sequence of Material
    rows : (P,) int
        Which of the materials each face gets.

    Returns
    -------
    dict
        The fields of `Restore` on how the slots were before.
    """
    mesh, layers = obj.data, layers_of(obj)
    before = layers.material_indices()
    uniform = before is None or bool((before == before[0]).all())
    slots = [material.name if material else "" for material in mesh.materials]
    tagged = [material.name for material in mesh.materials if is_ours(material)]
    active_slot = obj.active_material_index
    for material in materials:
        mesh.materials.append(material)
    obj.active_material_index = active_slot
    if before is not None and not uniform:
        layers.set_faces(MATERIAL_LAYER, before)
    layers.set_material_indices((rows + len(slots)).astype(np.int32))
    return {
        "slots": slots,
        "active_slot": active_slot,
        "material_index": int(before[0]) if uniform and before is not None else None,
        "had_material_index": before is not None,
        "tagged": tagged,
    }


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


def take_out_of_slots(
    obj: bpy.types.Object, restore: Restore
) -> list[bpy.types.Material]:
    """Take our materials out of the slots, and return them.

    Faces get the materials again that they had. Those with another material keep it.
    """
    layers = layers_of(obj)
    indices = _indices_without_ours(obj.data, restore, layers)
    materials = _erase_slots(obj, restore)
    layers.set_material_indices(indices)
    return materials


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
    """Return the indices of the slots that hold our materials.

    They come after the user's. Where the user deleted one of the materials, the slot is
    empty; no more than that are missing.
    """
    ours = [
        index
        for index, material in enumerate(mesh.materials)
        if is_ours(material) and not restore.had(material)
    ]
    first = min([len(restore.slots), *ours])
    empty = [i for i in range(first, len(mesh.materials)) if mesh.materials[i] is None]
    n_missing = 0 if KEPT_MATERIALS in mesh else max(len(restore.groups) - len(ours), 0)
    return sorted(ours + empty[:n_missing])


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
    materials = [mesh.materials[i] for i in ours if mesh.materials[i] is not None]
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
