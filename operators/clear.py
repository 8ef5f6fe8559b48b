"""Take back what the other operators left on objects."""

from __future__ import annotations

from typing import ClassVar

import bpy

from .bridge.hulls.hull_objects import erase_hulls
from .bridge.parts.erase import clear
from .bridge.parts.exploding import implode
from .bridge.parts.images import erase_images
from .bridge.read.target import refusal
from .bridge.stored.record import has_record
from .running.on_objects import OnEach


class WCD_OT_clear(OnEach, bpy.types.Operator):
    """Remove parts, hulls and whatever else was added to the object."""

    bl_idname = "wcd.clear"
    bl_label = "Clear Convex Parts"
    bl_description = (
        "Remove parts, hulls and whatever else was added to the selected objects"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @staticmethod
    def _refusal(obj: bpy.types.Object | None) -> str | None:
        reason = refusal(obj, writes_mesh=False)
        if reason is None and not has_record(obj):
            return f"{obj.name} has no parts to clear"
        return reason

    def _work(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        erase_hulls(obj)
        implode(obj)
        erase_images(obj)
        clear(obj)
