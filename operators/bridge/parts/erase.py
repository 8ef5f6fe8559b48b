"""Remove from an object what `write` wrote to it, and nothing else."""

from __future__ import annotations

import bpy
import numpy as np

from ..mesh.layers import layers_of
from ..mesh.seams import unmark_seams
from ..refusals import WORKED_ON
from ..stored.names import (
    COLOR_LAYER,
    FACE_SET_LAYER,
    FACE_SETS,
    LAYERS,
    WHOLE_LAYER,
    WHOLE_MESH,
)
from ..stored.record import (
    beside_parts,
    check_records,
    forget_parts,
    forget_result,
    record_of,
    write_record,
)
from ..stored.restore import Restore, read_restore, sharers, write_restore
from ..stored.users_groups import users_groups
from ..views.face_sets_and_colors import users_face_sets
from .materials import discard_unused, is_of_part, name_of, our_materials
from .part_materials import drop_kept, marked_groups
from .rows import erase_rows
from .slots import take_out_of_slots


def clear(obj: bpy.types.Object) -> None:
    """Remove everything of ours from an object, its mesh and the file.

    The parts of a mesh that is linked from a library stay, on the object, too. Of an
    object that the user converted to a curve or the like, record and rows are left.
    """
    if check_records(obj) and not obj.data.is_editable:
        own, record = beside_parts(obj).keys(), record_of(obj)
        write_record(obj, {key: record[key] for key in record if key not in own})
        return
    if obj.type in WORKED_ON:
        erase_parts(obj)
    else:
        erase_rows(obj)
    if obj.type == "MESH":
        unmark_seams(obj.data)
        _forget_joined_cuts(obj)
        _forget_color_names(obj.data)
    discard_unused(our_materials())  # also where the user removed their slots
    forget_result(obj)


def _forget_color_names(mesh: bpy.types.Mesh) -> None:
    """Let no color attribute of ours that is gone be the active or the default one.

    Another one is then, as if the user had removed it. Blender 5.2 leaves the names.
    """
    colors = mesh.color_attributes
    if COLOR_LAYER in colors:  # the user's: ours is gone
        return
    other = colors[0].name if len(colors) else ""
    active, default = colors.active_color_name, colors.default_color_name
    # Blender 5.0 needs to be told also that there is none.
    colors.active_color_name = other if active == COLOR_LAYER else active
    colors.default_color_name = other if default == COLOR_LAYER else default


def _forget_joined_cuts(obj: bpy.types.Object) -> None:
    """Remove what came with an object with cut faces that was joined to this one."""
    if WHOLE_MESH not in obj.data:
        layers = layers_of(obj)
        layers.remove(WHOLE_LAYER)
        layers.finish()


def erase_parts(obj: bpy.types.Object) -> list[bpy.types.Material]:
    """Remove the parts from a mesh; return the materials that showed them.

    Changes that the user made since stay: faces with another material keep it, and
    renamed groups and materials are not removed.
    """
    mesh = obj.data
    restore = read_restore(mesh)
    if restore is None:
        return _erase_remains(obj)
    has_ours = FACE_SET_LAYER in mesh.attributes
    face_sets = users_face_sets(obj, layers_of(obj)) if has_ours else None
    _erase_groups(obj, restore)
    layers = layers_of(obj)
    materials = [*take_out_of_slots(obj, restore), *drop_kept(mesh)]
    if face_sets is not None and face_sets.any():
        layers.set_faces(FACE_SETS, face_sets)
    elif face_sets is not None:
        layers.remove(FACE_SETS)
    for name in LAYERS:
        layers.remove(name)
    layers.finish()
    write_restore(mesh, None)
    for sharer in sharers(obj):
        forget_parts(sharer)
        erase_rows(sharer)
    return materials


def _erase_remains(obj: bpy.types.Object) -> list[bpy.types.Material]:
    """Remove the parts from points that were made of a mesh; return their materials.

    Blender drops our note and the numbers of the parts then. It keeps the slots and
    the record, and makes attributes of the groups.
    """
    data, entries = obj.data, record_of(obj).get("parts", ())
    if not entries or not data.is_editable:
        return []
    for name in {entry["name"] for entry in entries} - set(obj.vertex_groups.keys()):
        weights = data.attributes.get(name)
        if weights is not None and weights.data_type == "FLOAT":
            data.attributes.remove(weights)
    names = {entry["material"] for entry in entries}
    slots = [is_of_part(m) and m.name in names for m in data.materials]
    materials = [m for m, own in zip(data.materials, slots, strict=True) if own]
    for index in reversed(np.flatnonzero(slots)):
        data.materials.pop(index=int(index))
    for sharer in sharers(obj):
        forget_parts(sharer)
        erase_rows(sharer)
    return materials


def _erase_groups(obj: bpy.types.Object, restore: Restore) -> None:
    """Remove our vertex groups and make the user's group active again."""
    groups = obj.vertex_groups
    active = groups.active.name if groups.active else ""
    ours = {*restore.groups, *_joined_groups(obj, restore)}
    for name in ours - users_groups(obj, restore):
        if name in groups:
            groups.remove(groups[name])
    if active not in groups:
        active = restore.active_group
    if active in groups:
        groups.active_index = groups[active].index


def _joined_groups(obj: bpy.types.Object, restore: Restore) -> set[str]:
    """Return the names of groups of ours that came with objects joined to this one."""
    if not getattr(obj.data, "polygons", None):
        return set()
    found = set(marked_groups(obj).values())
    if restore.user_groups is not None:
        ours = [each for each in obj.data.materials if is_of_part(each)]
        found |= {name_of(m) for m in ours if not restore.had(m)}
    return found - set(restore.user_groups or ())
