"""Show in the Image Editor how the parts were found."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..core.parameters.choices import PICTURES
from ..core.parameters.parameter import Choice
from ..core.results import Picture
from ..core.steps.progress import Steps
from .bridge.parts.images import write_image
from .bridge.refusals import picture_refusal
from .bridge.work.computing import picture_of
from .running.computation import Computation


class WCD_OT_show_picture(Computation, bpy.types.Operator):
    """Show a picture of how the parts were found."""

    bl_idname = "wcd.show_picture"
    bl_label = "Show Convex Parts in Image Editor"
    bl_description = (
        "Draw how the parts were found. The image is kept in the file, and shown in"
        " open Image Editors"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @staticmethod
    def _refusal(obj: bpy.types.Object | None) -> str | None:
        return picture_refusal(obj)

    @classmethod
    def description(
        cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties
    ) -> str:
        """Return the tooltip of a picture's entry in the menu."""
        return _chosen_picture(properties).help

    def _begin(
        self, context: bpy.types.Context, obj: bpy.types.Object
    ) -> Steps[Picture]:
        return picture_of(obj, self.picture)

    def _commit(self, obj: bpy.types.Object, value: Picture) -> str:
        image = write_image(obj, _chosen_picture(self).label, value.pixels)
        if _show(image):
            return f"Image {image.name}"
        return f"Image {image.name}: open an Image Editor to see it"


WCD_OT_show_picture.__annotations__ = {
    "picture": bpy.props.EnumProperty(
        name="Picture",
        description="The picture to draw",
        items=[(each.identifier, each.label, each.help) for each in PICTURES],
    )
}


def _chosen_picture(properties: bpy.types.OperatorProperties) -> Choice:
    """Return the picture that an operator is to draw."""
    return next(each for each in PICTURES if each.identifier == properties.picture)


def _show(image: bpy.types.Image) -> bool:
    """Show an image in all open Image Editors; return whether there are any."""
    editors = [
        (window, area)
        for window in bpy.context.window_manager.windows
        for area in window.screen.areas
        if area.type == "IMAGE_EDITOR"
    ]
    for window, area in editors:
        area.spaces.active.image = image
        region = next(each for each in area.regions if each.type == "WINDOW")
        with bpy.context.temp_override(window=window, area=area, region=region):
            bpy.ops.image.view_all(fit_view=True)
    return bool(editors)
