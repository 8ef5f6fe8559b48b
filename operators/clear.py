"""Take back what the other operators left on the active object."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..core.errors import DecompositionError
from .bridge.erase import clear
from .bridge.hulls import erase_hulls
from .bridge.record import has_record
from .bridge.target import refusal


class WCD_OT_clear(bpy.types.Operator):
    """Remove parts, hulls and whatever else was added to the object."""

    bl_idname = "wcd.clear"
    bl_label = "Clear Convex Parts"
    bl_description = "Remove parts, hulls and whatever else was added to the object"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether there is anything to clear."""
        obj = context.active_object
        reason = refusal(obj, writes_mesh=False)
        if reason is None and not has_record(obj):
            reason = f"{obj.name} has no parts to clear"
        if reason:
            cls.poll_message_set(reason)
        return reason is None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Clear the active object."""
        try:
            erase_hulls(context.active_object)
            clear(context.active_object)
        except DecompositionError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}
