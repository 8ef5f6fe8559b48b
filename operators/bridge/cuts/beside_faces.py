"""What the user did to a cut mesh beside its geometry, and whole faces would lose.

It is compared with the mesh with the whole faces, which nobody edits.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ..mesh.attributes import read_labels
from ..mesh.layers import ObjectModeLayers
from ..stored.names import FACE_SETS, WHOLE_LAYER
from ..views.face_sets_and_colors import users_face_sets

# The types of modifiers that keep something by the numbers of vertices or faces. How
# they tell that they do, and the object whose mesh it is, if it is another one's.
_BOUND = {
    "SURFACE_DEFORM": ("is_bound", "target"),
    "MESH_DEFORM": ("is_bound", "object"),
    "LAPLACIANDEFORM": ("is_bind", ""),
    "CORRECTIVE_SMOOTH": ("is_bind", ""),
}


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
