"""Decompositions -> vertex groups, material slots, an attribute and a record."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...core.errors import DecompositionError
from ...core.parameters import Parameters
from .erase import MATERIAL_LAYER, PART_LAYER, erase_parts
from .layers import EditModeLayers, IntArray, ObjectModeLayers, layers_of
from .materials import discard_unused, part_materials, part_name
from .record import Restore, check_records, read_restore, write_restore, write_result
from .target import refusal

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ...core.decomposition import Decomposition


def write_parts(
    obj: bpy.types.Object, decomposition: Decomposition, parameters: Parameters
) -> None:
    """Show a decomposition on its object, in place of an earlier one.

    Everything is checked before anything is written.

    Raises
    ------
    DecompositionError
        If the object cannot be written to, or holds data of the user's under names
        that are needed.
    """
    check_writable(obj)
    if len(decomposition.labels) != len(obj.data.polygons):
        raise DecompositionError(
            "The mesh was changed while it was decomposed; start again."
        )
    former = erase_parts(obj)
    restore = _write_mesh(obj, decomposition)
    materials = [m.name for m in obj.data.materials[-decomposition.n_parts :]]
    write_restore(obj.data, restore)
    write_result(obj, decomposition, parameters, restore.groups, materials)
    discard_unused(former)


def check_writable(obj: bpy.types.Object) -> None:
    """Raise if parts cannot be written to an object."""
    reason = refusal(obj)
    if reason:
        raise DecompositionError(f"{reason}.")
    if obj.data.is_editmode:
        obj.update_from_editmode()
    check_records(obj)
    written = read_restore(obj.data) is not None
    for name in (PART_LAYER, MATERIAL_LAYER):
        attribute = obj.data.attributes.get(name)
        kind = attribute and (attribute.data_type, attribute.domain)
        allowed = (None, ("INT", "FACE")) if written else (None,)
        if kind not in allowed or name in obj.vertex_groups:
            raise DecompositionError(
                f"The mesh has an attribute or vertex group {name} that does not come"
                " from decomposing this object; rename or remove it in the mesh's"
                " properties."
            )


def _write_mesh(obj: bpy.types.Object, decomposition: Decomposition) -> Restore:
    """Write parts to a mesh that has none; return how to bring it back."""
    mesh = obj.data
    before = layers_of(obj).material_indices()
    uniform = before is None or bool((before == before[0]).all())
    slots = [material.name if material else "" for material in mesh.materials]
    active_group = obj.vertex_groups.active.name if obj.vertex_groups.active else ""
    active_slot = obj.active_material_index
    groups = _add_groups(obj, decomposition.n_parts, active_group)
    for material in part_materials(decomposition.n_parts, slots):
        mesh.materials.append(material)
    obj.active_material_index = active_slot
    layers = layers_of(obj)
    labels = decomposition.labels.astype(np.int32)
    if not uniform:
        layers.set_faces(MATERIAL_LAYER, before)
    layers.set_faces(PART_LAYER, labels)
    layers.set_material_indices(labels + len(slots))
    _fill_groups(obj, groups, labels, layers)
    layers.finish()
    return Restore(
        groups=groups,
        active_group=active_group,
        slots=slots,
        active_slot=active_slot,
        material_index=int(before[0]) if uniform and before is not None else None,
        had_material_index=before is not None,
    )


def _add_groups(obj: bpy.types.Object, n_parts: int, active: str) -> list[str]:
    """Add a group for each part, keep a group active; return the names given."""
    groups = obj.vertex_groups
    names = [groups.new(name=part_name(part)).name for part in range(n_parts)]
    groups.active_index = groups[active].index if active else 0
    return names


def _fill_groups(
    obj: bpy.types.Object,
    names: list[str],
    labels: IntArray,
    layers: ObjectModeLayers | EditModeLayers,
) -> None:
    """Put the vertices of each part's faces into its group."""
    mesh = obj.data
    corners = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    sizes = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("loop_total", sizes)
    part_of_corner = np.repeat(labels, sizes)
    for part, name in enumerate(names):
        vertices = np.unique(corners[part_of_corner == part])
        layers.fill_group(obj.vertex_groups[name], vertices)
