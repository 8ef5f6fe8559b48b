"""The settings of a scene: what the sidebar shows and operators take; presets."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ..core.parameters.presets import PRESETS, Preset, preset
from .settings import ALL, HULLS, RECUT, property_for

# Number of parts that Auto is switched to on an object without parts.
_FIRST_NUMBER = 6


def _are_here(settings: Any, context: bpy.types.Context) -> bool:
    """Return whether settings are those of the scene that operators would work in."""
    return bool(settings.id_data == context.scene)


def _recut(settings: Any, context: bpy.types.Context) -> None:
    """Replace the parts of the active object if the settings are live."""
    if settings.live and _are_here(settings, context) and bpy.ops.wcd.recut.poll():
        bpy.ops.wcd.recut()


def _show_hulls(settings: Any, context: bpy.types.Context) -> None:
    """Show the hulls of the selected objects as it is set."""
    if _are_here(settings, context) and bpy.ops.wcd.show_hulls.poll():
        bpy.ops.wcd.show_hulls(look=settings.look)


def _is_auto(settings: Any) -> bool:
    return bool(settings.parts == 0)


def _set_auto(settings: Any, auto: bool) -> None:
    """Leave the number of parts to the search, or take the number that there is."""
    here = _are_here(settings, bpy.context)
    obj = bpy.context.view_layer.objects.active if here else None
    settings.parts = 0 if auto else (len(obj.wcd_parts) if obj else 0) or _FIRST_NUMBER


def use_preset(settings: Any, chosen: Preset) -> None:
    """Set all settings of a scene to those of a preset."""
    parameters = chosen.parameters()
    live, settings.live = settings.live, False
    for name in ALL:
        setattr(settings, name, getattr(parameters, name))
    settings.live = live  # replaces the parts, once


class WCD_OT_use_preset(bpy.types.Operator):
    """Set all settings of the scene to those of a preset."""

    bl_idname = "wcd.use_preset"
    bl_label = "Use Convex Parts Preset"
    bl_description = (
        "Set all settings of parts to those of a preset, and Parts to Auto; settings of"
        " hulls and Colors stay"
    )
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
        description="The preset to use",
        items=[(each.identifier, each.label, each.help) for each in PRESETS],
    )
}


class WCD_PG_settings(bpy.types.PropertyGroup):
    """The settings of a scene; the sidebar shows them, and operators take them."""


WCD_PG_settings.__annotations__ = {
    **{name: property_for(name) for name in (*ALL, *HULLS, "keep_edits", "colors")},
    **{name: property_for(name, update=_recut) for name in (*RECUT, "mesh")},
    "look": property_for("look", update=_show_hulls),
    "auto_parts": bpy.props.BoolProperty(
        name="Auto",
        description="Let psi choose the number of parts; click to set it yourself",
        get=_is_auto,
        set=_set_auto,
    ),
    "highlight": bpy.props.BoolProperty(
        name="Highlight",
        description="Show in the viewports which parts are chosen in the list",
    ),
    "live": bpy.props.BoolProperty(
        name="Live",
        description=(
            "Replace the active object's parts as soon as a setting changes, such as"
            " their number or the detail. Settings that need new lines of sight are"
            " left out"
        ),
        update=_recut,
    ),
}

CLASSES = (WCD_PG_settings, WCD_OT_use_preset)


def register() -> None:
    """Give each scene its settings."""
    bpy.types.Scene.wcd = bpy.props.PointerProperty(type=WCD_PG_settings)


def unregister() -> None:
    """Undo `register`."""
    del bpy.types.Scene.wcd
