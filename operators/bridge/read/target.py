"""The object a computation is for, found again when the computation is done."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import bpy

from ....core.errors import DecompositionError
from ..mesh.points import count_points, is_cloud
from .converting import CONVERTIBLE, mesh_of

_WORKED_ON = {"MESH", "POINTCLOUD"}


def refusal(obj: bpy.types.Object | None, writes_mesh: bool = True) -> str | None:
    """Return why an object cannot be worked on, None if it can."""
    if obj is None:
        return "There is no active object; select a mesh"
    if obj.type in CONVERTIBLE:
        return (
            f"{obj.name} is not a mesh; Decompose makes one beside it, or convert it"
            " (Object > Convert > Mesh)"
        )
    if obj.type not in _WORKED_ON:
        return f"{obj.name} is not a mesh; select a mesh or a point cloud"
    if not obj.is_editable or (writes_mesh and not obj.data.is_editable):
        return (
            f"{obj.name} is linked from a library and cannot be changed; make it local"
            " first (Object > Relations > Make Local)"
        )
    if obj.mode not in {"OBJECT", "EDIT"}:
        return "Parts are made in Object or Edit Mode; switch the mode"
    if obj.mode == "EDIT" and is_cloud(obj):
        return "Parts of points are made in Object Mode; leave Edit Mode"
    return None


def chosen(
    context: bpy.types.Context, refusal: Callable[[bpy.types.Object], str | None]
) -> list[bpy.types.Object]:
    """Return what is to be worked on: those selected, or edited, that can be.

    The active object comes first. It is the only one if no other can be worked on, so
    that what it is refused for is told.
    """
    active = context.active_object
    if active and active.mode == "EDIT":
        there = context.objects_in_mode
    else:
        there = context.selected_objects
    fit = [obj for obj in there if refusal(obj) is None]
    return sorted(fit, key=lambda obj: obj != active) or [active]


def decompose_refusal(obj: bpy.types.Object | None) -> str | None:
    """Return why an object, or a copy in faces, cannot be decomposed, or None."""
    if obj is None or obj.type not in CONVERTIBLE:
        return refusal(obj)
    if not obj.is_editable:
        return (
            f"{obj.name} is linked from a library; make it local first (Object >"
            " Relations > Make Local)"
        )
    if obj.mode != "OBJECT":
        return f"{obj.name} is decomposed in Object Mode; leave Edit Mode"
    return None


def flush_edits(obj: bpy.types.Object) -> None:
    """Bring what was done to an object in Edit Mode to its mesh."""
    if obj.mode == "EDIT":
        obj.update_from_editmode()


@dataclass(frozen=True)
class Target:
    """What tells whether an object is still the one that was read.

    The object itself is not kept: undo and deletion leave such references dangling.
    """

    object_uid: int
    mesh_uid: int
    n_points: int
    n_polygons: int

    @classmethod
    def of(cls, obj: bpy.types.Object) -> Target:
        """Return the target that an object is now."""
        flush_edits(obj)
        if is_cloud(obj):
            counts = count_points(obj), 0
        else:
            with mesh_of(obj) as mesh:
                counts = len(mesh.vertices), len(mesh.polygons)
        return cls(obj.session_uid, obj.data.session_uid, *counts)

    def find(self) -> bpy.types.Object:
        """Return the object, or raise if it is gone or has changed."""
        for obj in bpy.data.objects:
            if obj.session_uid == self.object_uid:
                if obj.type in _WORKED_ON | CONVERTIBLE and Target.of(obj) == self:
                    return obj
                break
        raise DecompositionError(
            "The mesh was changed or deleted meanwhile; start again."
        )
