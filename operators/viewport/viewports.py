"""The 3D viewports: which one is under the cursor, and what their headers say."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import bpy
from bpy_extras import view3d_utils
from mathutils import Vector

# Clicks in other modes paint, sculpt or pose.
CLICKED_MODES = {"OBJECT", "EDIT_MESH"}


def no_viewport(context: bpy.types.Context) -> str | None:
    """Return that a context has no 3D viewport, None if it has one."""
    is_there = context.space_data and context.space_data.type == "VIEW_3D"
    return None if is_there else "There is no 3D viewport here"


def viewport_at(
    context: bpy.types.Context, x: int, y: int
) -> tuple[bpy.types.Region, int, int] | None:
    """Return the viewport at a point of the window, and the point in its pixels."""
    for area in context.window.screen.areas:
        there = [region for region in area.regions if _holds(region, x, y)]
        if area.type == "VIEW_3D" and {r.type for r in there} == {"WINDOW"}:
            return there[0], x - there[0].x, y - there[0].y
    return None


def ray_at(region: bpy.types.Region, x: int, y: int) -> tuple[Vector, Vector]:
    """Return the origin and direction, in the world, of what a pixel shows."""
    where = region, region.data, (x, y)
    return (
        view3d_utils.region_2d_to_origin_3d(*where),
        view3d_utils.region_2d_to_vector_3d(*where),
    )


def navigates(event: bpy.types.Event) -> bool:
    """Return whether a mouse button is pressed as some turn the view or box-select.

    Alt makes it the middle one where that is emulated.
    """
    return event.type in {"LEFTMOUSE", "RIGHTMOUSE"} and (event.alt or event.ctrl)


def redraw() -> None:
    """Let Blender draw the viewports and their sidebars again."""
    for window in bpy.context.window_manager.windows:
        for area in _areas(window.screen):
            area.tag_redraw()


def redraw_sidebars() -> None:
    """Let Blender draw the sidebars alone: a large scene takes long."""
    for window in bpy.context.window_manager.windows:
        for area in _areas(window.screen):
            for region in area.regions:
                if region.type == "UI":
                    region.tag_redraw()


def show_header(text: str | None) -> None:
    """Show a text in the headers of all viewports; None shows the usual ones again."""
    for screen in bpy.data.screens:
        for area in _areas(screen):
            area.header_text_set(text)


def _areas(screen: bpy.types.Screen) -> Iterator[bpy.types.Area]:
    """Return the viewports of a screen."""
    return (area for area in screen.areas if area.type == "VIEW_3D")


def _holds(region: Any, x: int, y: int) -> bool:
    """Return whether a point of the window is in a region."""
    return 0 <= x - region.x < region.width and 0 <= y - region.y < region.height
