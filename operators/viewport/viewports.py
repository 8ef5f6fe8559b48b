"""The 3D viewports: the one under the cursor, what they frame, what headers say."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import bpy
import numpy as np
from bpy_extras import view3d_utils
from mathutils import Vector

from ...core.geometry.frames import moved
from ...core.steps.arrays import BoolArray, FloatArray
from ..bridge.mesh.attributes import corner_vertices
from ..bridge.mesh.known import corner_faces
from ..bridge.mesh.points import is_cloud, positions_of

# Clicks in other modes paint, sculpt or pose.
CLICKED_MODES = {"OBJECT", "EDIT_MESH"}
# Shadings that leave out what is beyond a Clipping Region.
_CLIPPING = {"WIREFRAME", "SOLID"}
# How much wider the view is than what it frames.
_MARGIN = 1.1


def no_viewport(context: bpy.types.Context) -> str | None:
    """Return that a context has no 3D viewport, None if it has one."""
    is_there = context.space_data and context.space_data.type == "VIEW_3D"
    return None if is_there else "There is no 3D viewport here"


def viewport_at(
    context: bpy.types.Context, x: int, y: int
) -> tuple[bpy.types.Region, int, int] | None:
    """Return the viewport at a point of the window, and the point in its pixels.

    None where no ray can be told from a pixel: clipping from very near to very far
    leaves a view without an inverse in single precision.
    """
    for area in context.window.screen.areas:
        there = [region for region in area.regions if _holds(region, x, y)]
        if area.type == "VIEW_3D" and {r.type for r in there} == {"WINDOW"}:
            if not there[0].data.perspective_matrix.determinant():
                return None
            return there[0], x - there[0].x, y - there[0].y
    return None


def ray_at(region: bpy.types.Region, x: int, y: int) -> tuple[Vector, Vector]:
    """Return the origin and direction, in the world, of what a pixel shows."""
    view = region.data
    where = region, view, (x, y)
    origin = view3d_utils.region_2d_to_origin_3d(*where)
    if view.view_perspective == "CAMERA" and not view.is_perspective:
        # Blender begins half way between the clipping planes of such a camera.
        origin -= view.perspective_matrix.inverted().col[2].xyz
    return origin, view3d_utils.region_2d_to_vector_3d(*where)


def space_of(
    context: bpy.types.Context, region: bpy.types.Region
) -> bpy.types.SpaceView3D:
    """Return the space of a viewport of the window."""
    areas = context.window.screen.areas
    return next(area for area in areas if region in area.regions[:]).spaces.active


def shown_along(
    space: bpy.types.SpaceView3D,
    view: bpy.types.RegionView3D,
    origin: Vector,
    direction: Vector,
) -> tuple[float, float]:
    """Return from where to where a ray is within the Clipping Region (Alt B).

    Both are distances from the origin; the first is larger where it is nowhere.
    """
    near, far = 0.0, math.inf
    for *normal, offset in clip_planes(space, view):
        height = origin.dot(normal) + offset
        slope = direction.dot(normal)
        if slope > 0:
            near = max(near, -height / slope)
        elif slope < 0:
            far = min(far, -height / slope)
        elif height < 0:
            far = -math.inf
    return near, far


def clip_planes(
    space: bpy.types.SpaceView3D, view: bpy.types.RegionView3D
) -> list[Vector]:
    """Return the planes around the Clipping Region: what is behind one is left out."""
    if not view.use_clip_planes or space.shading.type not in _CLIPPING:
        return []
    return [Vector(plane) for plane in view.clip_planes[:4]]  # Blender sets no more


def ray_within(
    obj: bpy.types.Object, origin: Vector, direction: Vector
) -> tuple[Vector, Vector]:
    """Return a ray of the world in the space of an object."""
    to_object = obj.matrix_world.inverted_safe()
    return to_object @ origin, to_object.to_3x3() @ direction


def navigates(event: bpy.types.Event) -> bool:
    """Return whether a mouse button is pressed as some turn the view or box-select.

    Alt makes it the middle one where that is emulated.
    """
    return event.type in {"LEFTMOUSE", "RIGHTMOUSE"} and (event.alt or event.ctrl)


def points_of_parts(obj: bpy.types.Object, members: BoolArray) -> FloatArray:
    """Return the corners of some faces, or some points, in world space, (N, 3)."""
    places = positions_of(obj).astype(np.float64)
    if is_cloud(obj):
        places = places[members]
    else:
        vertices = corner_vertices(obj.data)
        places = places[vertices[members[corner_faces(obj.data)]]]
    return moved(places, np.array(obj.matrix_world))


def frame_points(context: bpy.types.Context, points: FloatArray) -> None:
    """Move a view so that it shows points, from the side it shows now.

    It is the one under the cursor, or from the sidebar of a Quad View the one in
    perspective.
    """
    if len(points) == 0:
        return
    space = context.space_data
    region = context.region_data or space.region_3d
    low, high = points.min(axis=0), points.max(axis=0)
    radius = max(float(np.linalg.norm(high - low)) / 2, 10 * space.clip_start)
    if region.view_perspective == "CAMERA":
        region.view_perspective = "PERSP"
    region.view_location = Vector((low + high) / 2)
    # The sensor of a viewport is 72 mm wide, twice that of a camera.
    region.view_distance = _MARGIN * radius / math.sin(math.atan(36 / space.lens))


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
