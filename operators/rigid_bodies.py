"""Let an object fall as what its hulls are together."""

from __future__ import annotations

from typing import ClassVar

import bpy

from .bridge.hulls import hull_refusal, hulls_of
from .bridge.rigid_bodies import make_rigid
from .bridge.target import chosen
from .each import do_each


class WCD_OT_make_rigid(bpy.types.Operator):
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

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether there are hulls."""
        reason = _refusal(chosen(context, _refusal)[0])
        if reason:
            cls.poll_message_set(reason)
        return reason is None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Work on the selected objects."""
        return do_each(self, chosen(context, _refusal), self._work)

    def _work(self, obj: bpy.types.Object) -> None:
        make_rigid(obj, hulls_of(obj), self.kind)


def _refusal(obj: bpy.types.Object | None) -> str | None:
    """Return why an object cannot be a rigid body of hulls, None if it can."""
    reason = hull_refusal(obj)
    if reason is None and not hulls_of(obj):
        return f"{obj.name} has no hulls; build them first"
    return reason
