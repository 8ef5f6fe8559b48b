"""Show in the Image Editor how the parts were found."""

from __future__ import annotations

from functools import partial

import bpy

from ..core.parameters.choices import PICTURES
from ..core.parameters.parameter import Choice
from ..core.results.views import Picture
from ..core.steps.progress import Steps
from .bridge.refusals import picture_refusal
from .bridge.views.images import write_image
from .bridge.work.computing import picture_of
from .running.computation import Computation


class WCD_OT_show_picture(Computation, bpy.types.Operator):
    """Show a picture of how the parts were found."""

    bl_idname = "wcd.show_picture"
    bl_label = "Show Convex Parts in Image Editor"
    bl_description = (
        "Draw how the parts were found. The image is kept in the file, and shown in"
        " the open Image Editors, or in a new one beside the viewport"
    )
    _refusal = staticmethod(picture_refusal)

    @classmethod
    def description(
        cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties
    ) -> str:
        """Return the tooltip of a picture's entry in the menu."""
        return _chosen_picture(properties).help

    def _begin(self, obj: bpy.types.Object) -> Steps[Picture]:
        return picture_of(obj, self.picture)

    def _commit(self, obj: bpy.types.Object, value: Picture) -> str:
        image = write_image(obj, _chosen_picture(self).label, value.pixels)
        show = partial(_show_named, image.name)
        if bpy.app.background:  # where no timers run
            show()
        else:
            bpy.app.timers.register(show)
        return f"Image {image.name}"


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


def _show_named(name: str) -> None:
    """Show an image in all open Image Editors, or in one that is opened for it.

    The area of a running operator must not become another editor: Blender goes on to
    use it, and would crash.
    """
    image = bpy.data.images.get(name)
    if image is None:  # undone in the meantime
        return
    for window, area in _editors("IMAGE_EDITOR") or _new_editors():
        area.spaces.active.image = image
        region = next(each for each in area.regions if each.type == "WINDOW")
        with bpy.context.temp_override(window=window, area=area, region=region):
            bpy.ops.image.view_all(fit_view=True)


def _editors(kind: str) -> list[tuple[bpy.types.Window, bpy.types.Area]]:
    """Return the areas that show editors of a kind, with their windows."""
    return [
        (window, area)
        for window in bpy.context.window_manager.windows
        for area in window.screen.areas
        if area.type == kind
    ]


def _new_editors() -> list[tuple[bpy.types.Window, bpy.types.Area]]:
    """Open an Image Editor in half of the largest viewport, if there is one.

    An area that fills the screen cannot be split; it becomes the editor then.
    """
    viewports = _editors("VIEW_3D")
    if not viewports:
        return []
    window, area = max(viewports, key=lambda each: each[1].width * each[1].height)
    there = set(window.screen.areas)
    with bpy.context.temp_override(window=window, area=area):
        if not window.screen.show_fullscreen:
            bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    for new in set(window.screen.areas) - there:
        area = new
    area.type = "IMAGE_EDITOR"
    return [(window, area)]
