"""What the user did to a cut mesh, and whole faces would lose.

A digest of what is on the faces is noted when they are cut. The rest is compared with
the mesh with the whole faces, which nobody edits.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from hashlib import blake2b
from typing import Any

import bpy
import numpy as np

from ....core.steps.arrays import Int32Array
from ..mesh.attributes import (
    corner_vertices,
    read_floats,
    read_ints,
    read_labels,
    values_of,
)
from ..mesh.layers import ObjectModeLayers
from ..mesh.seams import BLENDERS_LAYERS, users_seams
from ..parts.slots import bare_materials
from ..stored.names import FACE_SETS, WHOLE_LAYER
from ..stored.restore import read_restore
from ..views.face_sets_and_colors import users_face_sets

# Beginnings of the names of attributes that are no edits: ours, and what is selected or
# hidden.
_PASSING = ("wcd_", ".select", ".hide", ".uv_select", ".vs.", ".es.", ".pn.")
# Names of others that are none, or are compared in another way.
_APART = {"material_index", FACE_SETS, *BLENDERS_LAYERS}
# The types of modifiers that keep something by the numbers of vertices or faces. How
# they tell that they do, and the object whose mesh it is, if it is another one's.
_BOUND = {
    "SURFACE_DEFORM": ("is_bound", "target"),
    "MESH_DEFORM": ("is_bound", "object"),
    "LAPLACIANDEFORM": ("is_bind", ""),
    "CORRECTIVE_SMOOTH": ("is_bind", ""),
}


def face_state(obj: bpy.types.Object) -> str:
    """Return a digest of what the user could have edited on the faces of a mesh."""
    digest = blake2b(digest_size=16)
    indices, materials = bare_materials(obj, read_restore(obj.data))
    for name, values in _arrays(obj.data, indices):
        digest.update(name.encode())
        digest.update(np.ascontiguousarray(values).tobytes())
    digest.update(json.dumps([materials, *_named(obj)]).encode())
    return digest.hexdigest()


def _arrays(
    mesh: bpy.types.Mesh, indices: Int32Array | None
) -> Iterator[tuple[str, Any]]:
    """Yield arrays that the user could have edited, with their names.

    The `indices` are those of the user's materials.
    """
    yield "faces", read_ints(mesh.polygons, "loop_total")
    yield "corners", corner_vertices(mesh)
    yield "edges", read_ints(mesh.edges, "vertices", 2)
    yield "seams", () if mesh.is_editmode else users_seams(mesh)
    for attribute in sorted(mesh.attributes, key=lambda each: each.name):
        if attribute.name in _APART or attribute.name.startswith(_PASSING):
            continue
        values = values_of(attribute)
        if np.any(values):  # Edit Mode drops layers without any value
            yield f"{attribute.name} {attribute.domain}", values
    if indices is not None and indices.any():
        yield "materials", indices
    for key in getattr(mesh.shape_keys, "key_blocks", ()):
        yield key.name, read_floats(key.data, "co", 3)


def _named(obj: bpy.types.Object) -> list[Any]:
    """Return the user's groups, weights and custom properties."""
    mesh, restore = obj.data, read_restore(obj.data)
    groups = [g.name for g in obj.vertex_groups]
    ours = set(restore.groups) if restore else set()
    users = [name for name in groups if name not in ours]
    weights = [
        (vertex.index, groups[g.group], g.weight)
        for vertex in mesh.vertices
        for g in vertex.groups
        if g.group < len(groups) and groups[g.group] not in ours
    ]
    noted = {
        key: str(value.to_dict() if hasattr(value, "to_dict") else value)
        for key, value in mesh.items()
        if not key.startswith("wcd")
    }
    return [users, weights, noted]


def has_work_beside_faces(obj: bpy.types.Object, whole: bpy.types.Mesh) -> bool:
    """Return whether a cut mesh of known geometry has work that `whole` has not."""
    mesh = obj.data
    # Cuts are refused where there are sculpted details or bound modifiers: these came
    # later.
    if sculpted_details(obj) or bound_modifier(obj):
        return True
    if _animation(mesh) != _animation(whole):
        return True
    if _keys(mesh) != _keys(whole):
        return True
    return not _has_face_sets_of(obj, whole)


def sculpted_details(obj: bpy.types.Object) -> bool:
    """Return whether a Multires modifier of an object has details, on its faces."""
    return any(m.type == "MULTIRES" and m.total_levels > 0 for m in obj.modifiers)


def bound_modifier(obj: bpy.types.Object) -> bpy.types.Modifier | None:
    """Return a modifier that is bound to the vertices or faces of an object's mesh.

    It may be one of another object, which deforms with this one. None if there is none.
    """
    for owner in bpy.data.objects:
        for each in owner.modifiers:
            if each.type not in _BOUND or not getattr(each, _BOUND[each.type][0]):
                continue
            if each.type == "CORRECTIVE_SMOOTH" and each.rest_source != "BIND":
                continue
            target = getattr(each, _BOUND[each.type][1], None)
            if obj.data in (owner.data, target and target.data):
                return each
    return None


def _animation(mesh: bpy.types.Mesh) -> list[Any]:
    """Return the actions, tracks and drivers of a mesh and of its shape keys."""
    found: list[Any] = []
    for each in (mesh, mesh.shape_keys):
        animation = each.animation_data if each else None
        if animation is None:
            found.append((None, [], []))
            continue
        tracks = [(t.name, [s.name for s in t.strips]) for t in animation.nla_tracks]
        drivers = [_driver(curve) for curve in animation.drivers]
        found.append((animation.action, tracks, drivers))
    return found


def _driver(curve: bpy.types.FCurve) -> tuple[Any, ...]:
    """Return what a driver drives, and how."""
    driver = curve.driver
    variables = [
        (each.name, each.type, [target.data_path for target in each.targets])
        for each in driver.variables
    ]
    path = (curve.data_path, curve.array_index)
    return *path, driver.type, driver.expression, variables


def _keys(mesh: bpy.types.Mesh) -> list[tuple[Any, ...]]:
    """Return the settings of shape keys, without the values of their sliders."""
    return [
        (
            key.name,
            key.slider_min,
            key.slider_max,
            key.mute,
            key.vertex_group,
            key.relative_key.name,
        )
        for key in getattr(mesh.shape_keys, "key_blocks", ())
    ]


def _has_face_sets_of(obj: bpy.types.Object, whole: bpy.types.Mesh) -> bool:
    """Return whether the user's face sets are those of the whole faces."""
    now = users_face_sets(obj, ObjectModeLayers(obj))
    before = read_labels(whole, FACE_SETS, missing=0)
    wholes = read_labels(obj.data, WHOLE_LAYER, missing=-1)
    if now is None:
        now = np.zeros_like(wholes)
    if not now.any() and not before.any():
        return True
    if len(wholes) != len(now) or not np.isin(wholes, np.arange(len(before))).all():
        return False
    return np.array_equal(now, before[wholes])
