"""Let an object fall as what its hulls are together."""

from __future__ import annotations

from typing import ClassVar

import bpy

from .bridge.hulls.hull_objects import hull_refusal, hulls_of
from .bridge.hulls.rigid_bodies import make_rigid
from .running.on_objects import OnEach


class WCD_OT_make_rigid(OnEach, bpy.types.Operator):
    """Make rigid bodies of objects with hulls."""

    bl_idname = "wcd.make_rigid"
    bl_label = "Rigid Body of Hulls"
    bl_description = (
        "Make the object a rigid body in the shape of its hulls, for Blender's own"
        " simulation; Clear takes it back"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    kind: bpy.props.EnumProperty(
        name="Type",
        description="What becomes of the object in the simulation",
        items=(
            ("ACTIVE", "Active", "It falls and is pushed"),
            ("PASSIVE", "Passive", "It stays where it is, or as it is animated"),
        ),
    )

    @staticmethod
    def _refusal(obj: bpy.types.Object | None) -> str | None:
        reason = hull_refusal(obj)
        if reason is None and not hulls_of(obj):
            return f"{obj.name} has no hulls; build them first"
        return reason

    def _work(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        make_rigid(obj, hulls_of(obj), self.kind)
