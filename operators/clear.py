"""Take back what the other operators left on objects."""

from __future__ import annotations

from typing import ClassVar

import bpy

from .bridge.erase import clear
from .bridge.exploding import implode
from .bridge.hulls import erase_hulls
from .bridge.images import erase_images
from .bridge.record import has_record
from .bridge.target import chosen, refusal
from .each import do_each


class WCD_OT_clear(bpy.types.Operator):
    """Remove parts, hulls and whatever else was added to the object."""

    bl_idname = "wcd.clear"
    bl_label = "Clear Convex Parts"
    bl_description = (
        "Remove parts, hulls and whatever else was added to the selected objects"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether there is anything to clear."""
        reason = _refusal(chosen(context, _refusal)[0])
        if reason:
            cls.poll_message_set(reason)
        return reason is None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Clear the selected objects."""
        return do_each(self, chosen(context, _refusal), _clear)


def _clear(obj: bpy.types.Object) -> None:
    """Take everything of ours off an object."""
    erase_hulls(obj)
    implode(obj)
    erase_images(obj)
    clear(obj)


def _refusal(obj: bpy.types.Object | None) -> str | None:
    """Return why an object cannot be cleared, None if it can."""
    reason = refusal(obj, writes_mesh=False)
    if reason is None and not has_record(obj):
        return f"{obj.name} has no parts to clear"
    return reason
