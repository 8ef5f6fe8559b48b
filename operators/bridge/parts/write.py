"""Write a decomposition: vertex groups, material slots, an attribute and a record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import bpy
import numpy as np

from ....core.errors import DecompositionError
from ....core.parameters.parts import Parameters
from ....core.results.parts import Decomposition
from ....core.steps.arrays import BoolArray, IntArray
from ..cuts.new_faces import NewFaces
from ..hulls.listed import hulls_of
from ..mesh.attributes import write_attribute
from ..mesh.by_label import ByLabel
from ..mesh.fingerprint import to_be_noted
from ..mesh.layers import flush_edits, layers_of
from ..mesh.points import count_points, is_cloud
from ..refusals import refusal
from ..stored.identity import Identity
from ..stored.names import COLOR_LAYER, HAND_LAYER, LAYERS, NORMAL_LAYER, PART_LAYER
from ..stored.record import check_records, write_result
from ..stored.restore import Restore, sharers, write_restore
from ..views.colors import show_as_overlay
from ..views.face_sets_and_colors import paint_points, show, shown
from .continuing import BeforeWriting, by_number
from .erase import erase_parts
from .materials import discard_unused, is_of_part, own_materials, points_material
from .part_materials import is_overlaid
from .rows import write_rows
from .slots import put_in_slots


def write_parts(
    obj: bpy.types.Object,
    decomposition: Decomposition,
    parameters: Parameters,
    identities: Sequence[Identity] | None = None,
    by_hand: BoolArray | None = None,
    faces: NewFaces | None = None,
) -> None:
    """Show a decomposition on its object; everything is checked before it is written.

    Parameters
    ----------
    obj : bpy.types.Object
    decomposition : Decomposition
    parameters : Parameters
        To be recorded with it.
    identities : sequence of Identity, optional
        Who the parts are, after an edit; by default those they share most area with.
    by_hand : (P,) bool, optional
        Faces, or points, that the user settled by hand.
    faces : NewFaces, optional
        The faces that the object gets, if it does not have them already.

    Raises
    ------
    DecompositionError
        If the object cannot be written to, or the user has data under our names.
    """
    check_writable(obj)
    _check_fits(obj, decomposition, faces)
    overlaid, also_shown, before = is_overlaid(obj), shown(obj), BeforeWriting.of(obj)
    identities = identities or before.continued_by(obj, decomposition, faces)
    sources, former = before.materials, erase_parts(obj)
    former = _continued(former, [sources.get(each.number) for each in identities])
    if faces is not None:
        faces.put_on(obj)
    decomposition, by_label, identities = by_number(obj, decomposition, identities)
    identities, materials = _write_mesh(
        obj, decomposition, by_label, identities, sources, by_hand
    )
    measured_on = [to_be_noted(row) for row in by_label.sums]
    for sharer in sharers(obj):
        write_result(
            sharer, decomposition, parameters, identities, materials, measured_on
        )
        write_rows(sharer, identities, before.rows.get(sharer.name, {}))
    show(obj, *also_shown)
    if overlaid:
        show_as_overlay(obj)
    discard_unused(former)


def _check_fits(
    obj: bpy.types.Object, decomposition: Decomposition, faces: NewFaces | None
) -> None:
    """Raise if parts are not those of an object's faces, or of its new faces."""
    n_elements = count_points(obj) if is_cloud(obj) else len(obj.data.polygons)
    fits = faces.fit(obj) if faces else len(decomposition.labels) == n_elements
    if not fits:
        raise DecompositionError(
            "The mesh was changed while it was decomposed; start again."
        )


def check_writable(obj: bpy.types.Object) -> None:
    """Raise if parts cannot be written to an object."""
    reason = refusal(obj)
    if reason:
        raise DecompositionError(f"{reason}.")
    flush_edits(obj)
    _check_slots(obj)
    written = check_records(obj)
    for name, data_type in LAYERS.items():
        attribute = obj.data.attributes.get(name)
        # Points and the others: the user may turn a mesh into points, or back.
        domains, kinds = {"POINT", "FACE"}, {data_type}
        if name == COLOR_LAYER:  # and convert colors
            domains, kinds = {"POINT", "CORNER"}, {data_type, "BYTE_COLOR"}
        ours = attribute and written and attribute.domain in domains
        fits = attribute is None or (ours and attribute.data_type in kinds)
        if not fits or name in obj.vertex_groups:
            raise DecompositionError(
                f"The mesh has an attribute or vertex group {name} that does not come"
                " from decomposing this object; rename or remove it in the mesh's"
                " properties."
            )


def _check_slots(obj: bpy.types.Object) -> None:
    """Raise if an attribute of the user is where Blender keeps the slots of faces."""
    slots = obj.data.attributes.get("material_index")
    if is_cloud(obj) or slots is None:
        return
    if (slots.data_type, slots.domain) != ("INT", "FACE"):
        raise DecompositionError(
            "The mesh has an attribute material_index that is not one integer for each"
            " face; rename or remove it in the mesh's properties."
        )


def _continued(
    former: Sequence[bpy.types.Material],
    sources: Sequence[bpy.types.Material | None],
) -> list[bpy.types.Material]:
    """Return former materials without those of parts that end, which are removed.

    New materials may get their names then.
    """
    left = [each for each in former if each in sources or not is_of_part(each)]
    discard_unused([each for each in former if each not in left])
    return left


def _write_mesh(
    obj: bpy.types.Object,
    decomposition: Decomposition,
    by_label: ByLabel,
    identities: Sequence[Identity],
    sources: Mapping[int, bpy.types.Material | None],
    by_hand: BoolArray | None,
) -> tuple[Sequence[Identity], list[str]]:
    """Write parts to a mesh without parts, and how to bring it back.

    Return who the parts are, and the names of their materials.
    """
    identities, groups = _add_groups(obj, identities)
    materials = _materials(obj, identities, sources)
    slots = put_in_slots(obj, materials, decomposition.labels)
    write_restore(obj.data, Restore(**groups, **slots))
    _write_layers(obj, decomposition.labels, by_label, identities, by_hand)
    if is_cloud(obj):
        materials *= len(identities)  # they share it
        paint_points(obj, decomposition.labels, identities)
        if (normals := decomposition.normals) is not None:
            write_attribute(obj.data, NORMAL_LAYER, "FLOAT_VECTOR", "POINT", normals)
    return identities, [each.name for each in materials]


def _add_groups(
    obj: bpy.types.Object, identities: Sequence[Identity]
) -> tuple[Sequence[Identity], dict[str, Any]]:
    """Add a group for each part; the active one stays so.

    Return the parts, with a number behind names that were taken, and the fields of
    `Restore` on groups.
    """
    groups, names = obj.vertex_groups, []
    active = groups.active.name if groups.active else ""
    users = [group.name for group in groups]
    if obj.type == "MESH":  # point cloud objects have no groups
        names = [groups.new(name=identity.name).name for identity in identities]
        groups.active_index = groups[active].index if active else 0
        pairs = zip(identities, names, strict=True)
        identities = [replace(part, name=name) for part, name in pairs]
    fields = {"groups": names, "active_group": active, "user_groups": users}
    return identities, fields


def _write_layers(
    obj: bpy.types.Object,
    labels: IntArray,
    by_label: ByLabel,
    identities: Sequence[Identity],
    by_hand: BoolArray | None,
) -> None:
    """Write the number of each face's part, what is by hand, and who is in a group."""
    layers = layers_of(obj)
    numbers = np.array([part.number for part in identities], dtype=np.int32)
    layers.set_faces(PART_LAYER, numbers[labels])
    if by_hand is not None and by_hand.any():
        layers.set_faces(HAND_LAYER, by_hand.astype(np.int32))
    if obj.type == "MESH":
        for part, vertices in zip(identities, by_label.vertices, strict=True):
            layers.fill_group(obj.vertex_groups[part.name], vertices)
    layers.finish()


def _materials(
    obj: bpy.types.Object,
    identities: Sequence[Identity],
    sources: Mapping[int, bpy.types.Material | None],
) -> list[bpy.types.Material]:
    """Return a material for each part of a mesh, or one for all points."""
    if is_cloud(obj):
        return [points_material(obj.data)]
    return own_materials(identities, sources, hulls_of(obj))
