"""Set the sidebar's settings to those of a preset."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..core.parameters.presets import PRESETS, preset
from .settings import use_preset


class WCD_OT_use_preset(bpy.types.Operator):
    """Set all settings of the scene at once."""

    bl_idname = "wcd.use_preset"
    bl_label = "Use Convex Parts Preset"
    bl_description = "Set all settings in the sidebar to those of a preset"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def description(
        cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties
    ) -> str:
        """Return the tooltip of a preset's entry in the menu."""
        return preset(properties.preset).help

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Set them."""
        use_preset(context.scene.wcd, preset(self.preset))
        return {"FINISHED"}


WCD_OT_use_preset.__annotations__ = {
    "preset": bpy.props.EnumProperty(
        name="Preset",
        description="Settings to use",
        items=[(each.identifier, each.label, each.help) for each in PRESETS],
    )
}
