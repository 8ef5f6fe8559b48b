"""The mesh with whole faces, which an object had before its faces were cut.

The cut mesh is a copy, and the mesh before is kept as it was: nothing is written to it.
A custom property of the cut mesh points to it, so that Blender saves it.
"""

from __future__ import annotations

import bpy
import numpy as np

from ....core.steps.arrays import FloatArray, Int32Array, IntArray
from ..mesh.attributes import read_labels, write_attribute
from ..mesh.by_label import sums_of_all
from ..mesh.fingerprint import MEASURED_ON, fingerprint_of, fits
from ..mesh.seams import unmark_seams
from ..stored.names import CUT_STATE, WHOLE_LAYER, WHOLE_MESH
from ..stored.record import beside_parts, record_of, write_record
from ..stored.restore import sharers
from .users_work import face_state, has_work_beside_faces


def whole_mesh_of(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return the mesh of an object before its faces were cut.

    It is the object's mesh itself if no faces are cut, or if the user edited the mesh
    since: then its faces are the user's.
    """
    return obj.data if edited_since_cut(obj) else obj.data.get(WHOLE_MESH, obj.data)


def is_cut(obj: bpy.types.Object) -> bool:
    """Return whether faces of an object are cut."""
    return obj.type == "MESH" and isinstance(obj.data.get(WHOLE_MESH), bpy.types.Mesh)


def edited_since_cut(obj: bpy.types.Object) -> bool:
    """Return whether the user edited a mesh after its faces were cut."""
    if not is_cut(obj):
        return False
    if obj.data.get(CUT_STATE) != face_state(obj):
        return True
    return has_work_beside_faces(obj, obj.data[WHOLE_MESH])


def whole_faces(obj: bpy.types.Object) -> Int32Array:
    """Return the number of the whole face that each face of an object is of, (P,)."""
    if whole_mesh_of(obj) == obj.data:
        return np.arange(len(obj.data.polygons), dtype=np.int32)
    return read_labels(obj.data, WHOLE_LAYER, missing=-1)


def note_whole(obj: bpy.types.Object, faces: IntArray) -> None:
    """Note the whole face of each face, and the state, of an object without parts."""
    write_attribute(obj.data, WHOLE_LAYER, "INT", "FACE", faces)
    obj.data[CUT_STATE] = face_state(obj)


def forget_whole(mesh: bpy.types.Mesh) -> None:
    """Let the faces of a mesh be the user's: there is no way back.

    The mesh with the whole faces goes if nothing else needs it.
    """
    whole = mesh.get(WHOLE_MESH)
    for key in (WHOLE_MESH, CUT_STATE):
        if key in mesh:
            del mesh[key]
    layer = mesh.attributes.get(WHOLE_LAYER)
    if layer is not None:
        mesh.attributes.remove(layer)
    if isinstance(whole, bpy.types.Mesh) and whole.users == 0:
        bpy.data.meshes.remove(whole)


def bring_back(obj: bpy.types.Object) -> bool:
    """Give an object without parts its whole faces; return whether that was possible.

    Otherwise the cut faces stay, because the user edited them.
    """
    mesh = obj.data
    whole = whole_mesh_of(obj)
    if whole == mesh:
        forget_whole(mesh)
        return False
    put_back(obj, whole)
    unmark_seams(obj.data)  # which we marked before the faces were cut
    return True


def put_back(obj: bpy.types.Object, whole: bpy.types.Mesh) -> None:
    """Give an object, and those that share its mesh, the mesh with its whole faces."""
    replace_mesh(obj, whole.copy() if _is_needed_elsewhere(whole, obj.data) else whole)


def _is_needed_elsewhere(whole: bpy.types.Mesh, cut: bpy.types.Mesh) -> bool:
    """Return whether other objects show whole faces, or need them to get them back.

    Asset marks, fake users and references of the user's are no reason for a copy: what
    they are for is the mesh that comes back.
    """
    if any(obj.data == whole for obj in bpy.data.objects):
        return True
    others = (mesh for mesh in bpy.data.meshes if mesh != cut)
    return any(mesh.get(WHOLE_MESH) == whole for mesh in others)


def replace_mesh(obj: bpy.types.Object, mesh: bpy.types.Mesh) -> None:
    """Give an object, and those that share its mesh, another mesh of the same name.

    Its faces have the same shape. The former mesh is removed if nothing else uses it.
    """
    former, faces_before = obj.data, sums_of_all(obj)
    name, users = former.name, sharers(obj)
    _copy_key_values(former, mesh)
    for user in users:
        index = user.active_shape_key_index
        user.data = mesh
        user.active_shape_key_index = index
        _keep_figures(user, faces_before)
    former.name = f"{name} (whole)"
    mesh.name = name
    if former.users == 0:
        bpy.data.meshes.remove(former)


def _keep_figures(obj: bpy.types.Object, before: FloatArray) -> None:
    """Let figures of an object with other faces before be those of its faces now."""
    record = record_of(obj)
    figures = [record[key] for key in beside_parts(obj) if fits(record[key], before)]
    for each in figures:
        each[MEASURED_ON] = fingerprint_of(obj)
    if figures:
        write_record(obj, record)


def _copy_key_values(former: bpy.types.Mesh, mesh: bpy.types.Mesh) -> None:
    """Copy the values of shape keys: the user may have moved their sliders."""
    if former.shape_keys and mesh.shape_keys:
        for key in mesh.shape_keys.key_blocks:
            there = former.shape_keys.key_blocks.get(key.name)
            if there is not None and there.value != key.value:
                key.value = there.value
