"""Draw what is behind transparent hulls of ours, as far as a viewport hides it.

Solid shading notes the depth of transparent solids, too, so what is drawn later behind
them is not seen. So it is drawn into a picture of its own first, and hulls that are in
front show that picture.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, lru_cache
from typing import Any

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ..core.steps.arrays import Float32Array
from ..operators.bridge.mesh.known import triangles_of
from ..operators.bridge.stored.names import HULL_TAG
from .clipping import planes_in

# The kind of color in Solid shading that no object is transparent in.
_OPAQUE = "SINGLE"
# How much nearer than its surface a hull is drawn, as a share of the depth.
_NEARER = 1e-6


def transparent_hulls(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Return the hulls that the viewport of a context shows as transparent solids."""
    space = context.space_data
    shading = space.shading
    if shading.type != "SOLID" or shading.color_type == _OPAQUE:
        return []
    return [
        obj
        for obj in context.visible_objects
        if HULL_TAG in obj
        and obj.display_type == "TEXTURED"
        and obj.color[3] < 1
        and obj.visible_in_viewport_get(space)
    ]


def draw_through(hulls: Sequence[bpy.types.Object], draw: Callable[[], None]) -> None:
    """Let hulls show what is drawn, on transparent white, where they are in front."""
    view, noting = bpy.context.region_data, gpu.state.depth_mask_get()
    colors, picture, _ = _picture(*gpu.state.viewport_get()[2:])
    gpu.state.depth_mask_set(True)
    with picture.bind(), gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
        picture.clear(color=(1, 1, 1, 0), depth=1.0)
        gpu.matrix.load_matrix(view.view_matrix)
        gpu.matrix.load_projection_matrix(view.window_matrix)
        draw()
    gpu.state.depth_mask_set(noting)
    gpu.state.blend_set("ALPHA")
    places = np.concatenate([_on_screen(hull, view) for hull in hulls])
    if len(places):
        _show(colors, places, view)


@lru_cache(maxsize=1)  # to be used again, mostly
def _picture(width: int, height: int) -> tuple[Any, Any, Any]:
    """Return the colors of a picture of a size, what draws into it, and its depth."""
    size = width, height
    colors = gpu.types.GPUTexture(size, format="SRGB8_A8")  # as of the viewports
    depth = gpu.types.GPUTexture(size, format="DEPTH_COMPONENT32F")
    return colors, gpu.types.GPUFrameBuffer(depth_slot=depth, color_slots=colors), depth


def forget() -> None:
    """Forget the picture and the shader."""
    _picture.cache_clear()
    _shader.cache_clear()


def _on_screen(hull: bpy.types.Object, view: bpy.types.RegionView3D) -> Float32Array:
    """Return the corners of a hull's triangles, (N, 3): from -1 to 1 on the screen."""
    vertices, triangles, _ = triangles_of(hull.data)
    matrix = np.array(view.perspective_matrix @ hull.matrix_world)
    corners = (vertices @ matrix[:, :3].T + matrix[:, 3])[triangles]
    corners = corners[(corners[:, :, 3] > 0).all(axis=1)].reshape(-1, 4)
    places = corners[:, :3] / corners[:, 3:]
    places[:, 2] -= _NEARER
    return places.astype(np.float32)


def _show(colors: Any, places: Float32Array, view: bpy.types.RegionView3D) -> None:
    """Draw colors that fill the screen, on some places of it within its region."""
    shader, planes = _shader(), np.zeros((4, 4))
    within = planes_in(view.perspective_matrix.inverted())
    planes[: len(within)] = within
    shader.bind()
    shader.uniform_float("planes", Matrix(planes))
    shader.uniform_sampler("colors", colors)
    batch_for_shader(shader, "TRIS", {"place": places}).draw(shader)


@cache
def _shader() -> Any:
    """Return a shader that copies linear colors; not all of Blender's own do."""
    info = gpu.types.GPUShaderCreateInfo()
    between = gpu.types.GPUStageInterfaceInfo("wcd_through_hulls")
    between.smooth("VEC3", "at")
    info.vertex_in(0, "VEC3", "place")
    info.vertex_out(between)
    info.push_constant("MAT4", "planes")
    info.sampler(0, "FLOAT_2D", "colors")
    info.fragment_out(0, "VEC4", "color")
    info.vertex_source("void main() { at = place; gl_Position = vec4(place, 1.0); }")
    info.fragment_source(
        "void main() {"
        " if (any(lessThan(planes * vec4(at, 1.0), vec4(0.0)))) discard;"
        " color = texture(colors, 0.5 + at.xy / 2.0); }"
    )
    return gpu.shader.create_from_info(info)
