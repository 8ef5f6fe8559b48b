"""The object a computation is for, found again when the computation is done."""

from __future__ import annotations

from dataclasses import dataclass

import bpy

from ...core.errors import DecompositionError


def refusal(obj: bpy.types.Object | None, writes_mesh: bool = True) -> str | None:
    """Return why an object cannot be worked on, None if it can."""
    if obj is None:
        return "There is no active object; select a mesh"
    if obj.type != "MESH":
        return f"{obj.name} is not a mesh; select a mesh"
    if not obj.is_editable or (writes_mesh and not obj.data.is_editable):
        return (
            f"{obj.name} is linked from a library and cannot be changed; make it local"
            " first (Object > Relations > Make Local)"
        )
    if obj.mode not in {"OBJECT", "EDIT"}:
        return "Parts are made in Object or Edit Mode; switch the mode"
    return None


@dataclass(frozen=True)
class Target:
    """What tells whether an object is still the one that was read.

    The object itself is not kept: undo and deletion leave such references dangling.
    """

    object_uid: int
    mesh_uid: int
    n_vertices: int
    n_polygons: int

    @classmethod
    def of(cls, obj: bpy.types.Object) -> Target:
        """Return the target that an object is now."""
        mesh = obj.data
        if mesh.is_editmode:
            obj.update_from_editmode()
        return cls(
            obj.session_uid,
            mesh.session_uid,
            len(mesh.vertices),
            len(mesh.polygons),
        )

    def find(self) -> bpy.types.Object:
        """Return the object, or raise if it is gone or has changed."""
        for obj in bpy.data.objects:
            if obj.session_uid == self.object_uid:
                if obj.type == "MESH" and Target.of(obj) == self:
                    return obj
                break
        raise DecompositionError(
            "The mesh was changed or deleted meanwhile; start again."
        )
