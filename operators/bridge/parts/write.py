"""Write a decomposition: vertex groups, material slots, an attribute and a record."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import bpy
import numpy as np

from ....core.errors import DecompositionError
from ....core.parameters.parts import Parameters
from ....core.results import Decomposition
from ..mesh.attributes import IntArray
from ..mesh.corners import corner_faces, corner_vertices
from ..mesh.layers import flush_edits, layers_of
from ..mesh.points import count_points, is_cloud, set_points
from ..refusals import refusal
from ..stored.identity import Identity, usual_identities
from ..stored.names import COLOR_LAYER, LAYERS, MATERIAL_LAYER, NORMAL_LAYER, PART_LAYER
from ..stored.record import (
    check_records,
    identities_of,
    record_of,
    share_result,
    write_result,
)
from ..stored.restore import Restore, write_restore
from .erase import erase_parts
from .face_sets_and_colors import show, shown
from .materials import discard_unused, part_materials, points_material
from .palette import part_color
from .rows import kept_rows, write_rows


def write_parts(
    obj: bpy.types.Object,
    decomposition: Decomposition,
    parameters: Parameters,
    kept: tuple[Identity, ...] | None = None,
) -> None:
    """Show a decomposition on its object, in place of an earlier one.

    Everything is checked before anything is written.

    Parameters
    ----------
    obj : bpy.types.Object
    decomposition : Decomposition
    parameters : Parameters
        To be recorded with it.
    kept : tuple of Identity, optional
        The identities of all parts, if some of them were there before. Those keep their
        names, colors, ticks and locks. Without it all parts are new.

    Raises
    ------
    DecompositionError
        If the object cannot be written to, or the user has data under our names.
    """
    check_writable(obj)
    n_elements = count_points(obj) if is_cloud(obj) else len(obj.data.polygons)
    if len(decomposition.labels) != n_elements:
        raise DecompositionError(
            "The mesh was changed while it was decomposed; start again."
        )
    also_shown = shown(obj)
    identities = kept or usual_identities(decomposition.n_parts)
    rows = kept_rows(obj) if kept else {}
    former = erase_parts(obj)
    restore = _write_mesh(obj, decomposition, identities)
    if is_cloud(obj):
        _write_points(obj, decomposition, identities)
    write_restore(obj.data, restore)
    if restore.groups:
        identities = tuple(
            replace(identity, name=group)
            for identity, group in zip(identities, restore.groups, strict=True)
        )
    materials = _material_names(obj, len(identities))
    write_result(obj, decomposition, parameters, identities, materials)
    write_rows(obj, identities, rows)
    show(obj, *also_shown)
    discard_unused(former)


def share_parts(first: bpy.types.Object, obj: bpy.types.Object) -> None:
    """Note the parts of `first` on another object that has its mesh.

    Parameters
    ----------
    first : bpy.types.Object
        An object that `write_parts` wrote to.
    obj : bpy.types.Object
        Its own measurements and hulls stay noted.
    """
    record = record_of(first)
    share_result(record, obj)
    write_rows(obj, identities_of(record), {})


def _material_names(obj: bpy.types.Object, n_parts: int) -> list[str]:
    """Return the name of each part's material. All parts of a cloud share one."""
    names = [material.name for material in obj.data.materials[-n_parts:]]
    return names[-1:] * n_parts if is_cloud(obj) else names


def check_writable(obj: bpy.types.Object) -> None:
    """Raise if parts cannot be written to an object."""
    reason = refusal(obj)
    if reason:
        raise DecompositionError(f"{reason}.")
    flush_edits(obj)
    written = check_records(obj)
    for name, data_type in LAYERS.items():
        attribute = obj.data.attributes.get(name)
        # Points and faces both: the user may turn a mesh into points, or back.
        ours = attribute and written and attribute.domain in {"FACE", "POINT"}
        fits = attribute is None or (ours and attribute.data_type == data_type)
        if not fits or name in obj.vertex_groups:
            raise DecompositionError(
                f"The mesh has an attribute or vertex group {name} that does not come"
                " from decomposing this object; rename or remove it in the mesh's"
                " properties."
            )


def _write_mesh(
    obj: bpy.types.Object,
    decomposition: Decomposition,
    identities: Sequence[Identity],
) -> Restore:
    """Write parts to a mesh without parts; return how to bring it back."""
    mesh = obj.data
    before = layers_of(obj).material_indices()
    uniform = before is None or bool((before == before[0]).all())
    slots = [material.name if material else "" for material in mesh.materials]
    active_group = obj.vertex_groups.active.name if obj.vertex_groups.active else ""
    active_slot = obj.active_material_index
    groups = []
    if obj.type == "MESH":  # point cloud objects have no groups
        groups = _add_groups(obj, identities, active_group)
    for material in _materials(obj, identities, slots):
        mesh.materials.append(material)
    obj.active_material_index = active_slot
    layers = layers_of(obj)
    labels = decomposition.labels.astype(np.int32)
    if before is not None and not uniform:
        layers.set_faces(MATERIAL_LAYER, before)
    layers.set_faces(PART_LAYER, labels)
    layers.set_material_indices(labels + len(slots))
    members = _vertices_by_part(obj, labels, len(groups))
    for name, vertices in zip(groups, members, strict=True):
        layers.fill_group(obj.vertex_groups[name], vertices)
    layers.finish()
    return Restore(
        groups=groups,
        active_group=active_group,
        slots=slots,
        active_slot=active_slot,
        material_index=int(before[0]) if uniform and before is not None else None,
        had_material_index=before is not None,
    )


def _add_groups(
    obj: bpy.types.Object, identities: Sequence[Identity], active: str
) -> list[str]:
    """Add a group for each part; return the groups' names. `active` stays active."""
    groups = obj.vertex_groups
    names = [groups.new(name=identity.name).name for identity in identities]
    groups.active_index = groups[active].index if active else 0
    return names


def _materials(
    obj: bpy.types.Object, identities: Sequence[Identity], slots: list[str]
) -> list[bpy.types.Material]:
    """Return a material for each part of a mesh, or one for all points."""
    if is_cloud(obj):
        return [points_material(COLOR_LAYER, slots)]
    return part_materials(identities, slots)


def _write_points(
    obj: bpy.types.Object,
    decomposition: Decomposition,
    identities: Sequence[Identity],
) -> None:
    """Write the colors of points, and their normals if we estimated them."""
    palette = np.array([part_color(identity.number) for identity in identities])
    set_points(obj, COLOR_LAYER, "FLOAT_COLOR", palette[decomposition.labels])
    if decomposition.normals is not None:
        set_points(obj, NORMAL_LAYER, "FLOAT_VECTOR", decomposition.normals)


def _vertices_by_part(
    obj: bpy.types.Object, labels: IntArray, n_parts: int
) -> Iterator[IntArray]:
    """Yield the vertices, or points, of each part."""
    if is_cloud(obj):
        vertices, parts = np.arange(len(labels), dtype=np.int32), labels
    else:
        vertices = corner_vertices(obj.data)
        parts = labels[corner_faces(obj.data)]
    for part in range(n_parts):
        yield np.unique(vertices[parts == part])
