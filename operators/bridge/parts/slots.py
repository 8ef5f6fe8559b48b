"""The material slots of parts: put in for a result, and taken out again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ....core.steps.arrays import Int32Array
from ..mesh.layers import EditModeLayers, ObjectModeLayers, layers_of
from ..mesh.points import is_cloud
from ..stored.names import FORMER_SLOTS, KEPT_MATERIALS, MATERIAL_LAYER
from ..stored.notes import read_note, write_note
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
    before, slots = layers.material_indices(), _names_in(mesh)
    differ = before is not None and bool((before != before[0]).any())
    index = None if differ else 0 if before is None else int(before[0])
    tagged = [material.name for material in mesh.materials if is_ours(material)]
    active_slot = obj.active_material_index
    for material in materials:
        mesh.materials.append(material)
        if not is_cloud(obj):  # clouds share theirs
            write_note(material, FORMER_SLOTS, {"slots": slots, "index": index})
    obj.active_material_index = active_slot
    if before is not None and differ:
        layers.set_faces(MATERIAL_LAYER, before)
    layers.set_material_indices((rows + len(slots)).astype(np.int32))
    return {
        "slots": slots,
        "active_slot": active_slot,
        "material_index": index,
        "had_material_index": before is not None,
        "tagged": tagged,
    }


def bare_materials(
    obj: bpy.types.Object, restore: Restore | None
) -> tuple[Int32Array | None, list[str]]:
    """Return the material index of each face, and the names of the user's materials.

    Both are as they would be without our slots.
    """
    mesh, layers = obj.data, layers_of(obj)
    if restore is None:
        return layers.material_indices(), _names_in(mesh)
    indices, remaining = _bare_slots(mesh, restore, layers)
    return indices, [*remaining.values()]


def take_out_of_slots(
    obj: bpy.types.Object, restore: Restore
) -> list[bpy.types.Material]:
    """Take our materials out of the slots, and return them.

    Faces get the materials again that they had. Those with another material keep it.
    """
    layers = layers_of(obj)
    indices, remaining = _bare_slots(obj.data, restore, layers)
    materials = _erase_slots(obj, restore, remaining)
    layers.set_material_indices(indices)
    return materials


def _bare_slots(
    mesh: bpy.types.Mesh, restore: Restore, layers: ObjectModeLayers | EditModeLayers
) -> tuple[Int32Array | None, dict[int, str]]:
    """Return what is left of the slots of a mesh without our materials.

    These are the material index of each face, and the slots that stay, each with the
    name of its material. One of ours stays, with "" for a name, if other faces have
    materials and some had none.
    """
    names, ours = _names_in(mesh), _our_slots(mesh, restore)
    remaining = {slot: n for slot, n in enumerate(names) if slot not in ours}
    if not getattr(mesh, "polygons", None):  # points
        return None, remaining
    now = layers.material_indices()
    if now is None:
        now = np.zeros(len(mesh.polygons), dtype=np.int32)
    sources = _sources(mesh, restore, ours)
    lacking = [slot for each in sources if not each.slots for slot in each.ours]
    without = np.isin(now, lacking)
    mixed = without.any() and not without.all()  # as after a join
    if mixed and "" not in remaining.values():
        remaining = dict(sorted([*remaining.items(), (min(lacking), "")]))
    gone, left = [s for s in ours if s not in remaining], [*remaining.values()]
    indices = (now - np.searchsorted(gone, now)).astype(np.int32)
    layer = layers.faces(MATERIAL_LAYER)
    for source in sources:
        before = np.full_like(now, source.index or 0)
        if source.index is None and layer is not None:
            before = layer
        own, rows = source.slots == restore.slots, np.isin(now, source.ours)
        indices[rows] = _moved(before[rows], source.slots, left, own)
    if mixed:
        indices[without] = left.index("")
    no_need = not restore.had_material_index and not indices.any()
    return None if no_need else indices, remaining


@dataclass(frozen=True)
class _Source:
    """What objects had whose parts some of our slots are of: this one, or joined ones.

    Attributes
    ----------
    slots : list of str
        Names of the materials in their slots before.
    index : int or None
        The material index of all their faces before, None if faces had different ones.
    ours : list of int
        Our slots, in this mesh now.
    """

    slots: list[str]
    index: int | None
    ours: list[int]


def _sources(
    mesh: bpy.types.Mesh, restore: Restore, ours: Sequence[int]
) -> list[_Source]:
    """Return whose parts our slots are of: each material of ours notes it."""
    found: dict[tuple[Any, ...], _Source] = {}
    own: dict[str, Any] = {"slots": restore.slots, "index": restore.material_index}
    for slot in ours:
        material = mesh.materials[slot]
        noted = (material and read_note(material, FORMER_SLOTS)) or own
        slots, index = noted["slots"], noted["index"]
        source = found.setdefault((*slots, index), _Source(slots, index, []))
        source.ours.append(slot)
    return [*found.values()]


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


def _names_in(mesh: bpy.types.Mesh) -> list[str]:
    """Return the names of the materials in the slots of a mesh, "" for none."""
    return [material.name if material else "" for material in mesh.materials]


def _moved(
    indices: Int32Array, slots: Sequence[str], remaining: list[str], own: bool
) -> Int32Array:
    """Return indices of former slots as indices of the slots that will remain.

    The user may have moved, removed or renamed materials since. Only slots that are the
    object's `own` tell where renamed ones are.
    """
    moved = indices.copy()
    place = 0  # Blender gives the faces of a removed slot to the slot before
    for former, name in enumerate(slots):
        there = remaining[former] if former < len(remaining) else None
        renamed = own and name not in remaining and there not in (None, *slots)
        if there == name or renamed:
            place = former
        elif name in remaining:
            place = remaining.index(name)
        moved[indices == former] = place
    return moved


def _erase_slots(
    obj: bpy.types.Object, restore: Restore, remaining: dict[int, str]
) -> list[bpy.types.Material]:
    """Leave only the slots `remaining`; return the materials that go."""
    mesh, active, before = obj.data, obj.active_material_index, [*obj.data.materials]
    for slot, name in remaining.items():
        if before[slot] is not None and not name:
            mesh.materials[slot] = None
    gone = [slot for slot in range(len(before)) if slot not in remaining]
    if gone:
        _remove_slots(obj, gone)
    if gone and mesh.materials:
        n_before = sum(slot < active for slot in gone)
        active = restore.active_slot if active in gone else active - n_before
        obj.active_material_index = min(active, len(mesh.materials) - 1)
    slots = enumerate(before)
    return [m for slot, m in slots if m is not None and m.name != remaining.get(slot)]


def _remove_slots(obj: bpy.types.Object, gone: list[int]) -> None:
    """Remove slots of a mesh, and those of the objects that have it.

    Blender does not move the objects' own materials in the slots behind.
    """
    mesh = obj.data
    linked = [
        (sharer, [(slot.link, slot.material) for slot in sharer.material_slots])
        for sharer in sharers(obj)
    ]
    if len(gone) == len(mesh.materials):
        mesh.materials.clear()  # `pop` would leave the objects an empty slot
    for index in reversed(gone if mesh.materials else ()):
        mesh.materials.pop(index=index)
    for sharer, slots in linked:
        kept = [each for index, each in enumerate(slots) if index not in gone]
        for slot, (link, material) in zip(sharer.material_slots, kept, strict=False):
            if slot.link != link:
                slot.link = link
            if link == "OBJECT" and slot.material != material:
                slot.material = material
