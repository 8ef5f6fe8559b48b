"""Draw parts over the viewports: the one under the cursor, chosen ones, and colors."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import blf
import bpy
import gpu
from gpu_extras.batch import batch_for_shader

from ..core.steps.arrays import Float32Array
from ..operators.bridge.parts.palette import srgb_of
from ..operators.bridge.parts.part_materials import is_overlaid
from ..operators.bridge.parts.rows import chosen_numbers, look_left
from ..operators.bridge.refusals import faces_refusal
from ..operators.bridge.watching import start_timer, stop_timer
from ..operators.viewport import picking
from ..operators.viewport.shown_parts import ShownParts, shown_identities, shown_parts
from ..operators.viewport.viewports import redraw
from .clipping import clipped_shader, draw_clipped, lines_within, planes_in
from .clipping import forget as forget_planes
from .through_hulls import draw_through, forget, transparent_hulls

# How opaque the colors of an overlay are: less in Edit Mode, where edges are seen.
# And the tints of what is under the cursor and what is chosen.
_OPAQUE = (0.65, 0.3)
_HOVERED = (1.0, 1.0, 1.0, 0.14)
_CHOSEN = (1.0, 1.0, 1.0, 0.1)
_NONE = (1.0, 1.0, 1.0, 0.0)
# Most faces of an object on which a click in the list shows the part by itself: they
# are read in a tenth of a second.
_MOST_AT_A_CLICK = 150_000
# Widths of borders, in points at interface scale 1.
_HOVERED_WIDTH = 2.5
_CHOSEN_WIDTH = 2.0
# How much nearer than its surface all this is drawn, as a share of the distance; a tint
# is nearer than a color, and a border nearer than a tint.
_NEARER = 4e-4
# Distance of a name from the cursor, its margins and its size, at interface scale 1.
_BESIDE, _MARGIN, _SIZE = 18, 6, 12


def stop() -> None:
    """Draw no more, and forget what was made for it."""
    stop_timer(redraw)
    forget()
    forget_planes()


def draw() -> None:
    """Draw over a viewport."""
    context = bpy.context
    space = context.space_data
    if not space.overlay.show_overlays:
        return
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("LESS_EQUAL")
    overlaid = [each for each in context.visible_objects if is_overlaid(each)]
    _draw_colors(context, overlaid)
    _draw_chosen(context)
    _draw_hovered(context)
    if overlaid or _shows_chosen(context):
        hulls = transparent_hulls(context)
        if hulls:
            draw_through(hulls, lambda: _draw_on_white(context))
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")


def _draw_colors(
    context: bpy.types.Context, objects: Iterable[bpy.types.Object]
) -> None:
    """Draw parts in their colors, in none where these are no overlay."""
    for obj in objects:
        shown = shown_parts(obj)
        if shown is None or not obj.visible_in_viewport_get(context.space_data):
            continue
        opaque = _OPAQUE[obj.mode == "EDIT"]
        for number, identity in shown_identities(obj).items():
            color = (*srgb_of(identity.color), opaque)
            _fill(obj, shown, number, color if is_overlaid(obj) else _NONE, 1)


def _draw_on_white(context: bpy.types.Context) -> None:
    """Draw the same on what is transparent white."""
    gpu.state.blend_set("NONE")
    _draw_colors(context, context.visible_objects)
    gpu.state.blend_set("ALPHA")
    _draw_chosen(context)
    _draw_hovered(context)


def _shows_chosen(context: bpy.types.Context) -> bool:
    """Return whether chosen parts are shown: always, or a moment after a click.

    Then the viewports are drawn once more after that moment.
    """
    if picking.current is not None or context.scene.wcd.highlight:
        return True
    obj = context.active_object
    if obj is None or obj.type != "MESH" or len(obj.data.polygons) > _MOST_AT_A_CLICK:
        return False
    left = look_left(obj)
    if left:
        start_timer(redraw, left)
    return left > 0


def _draw_chosen(context: bpy.types.Context) -> None:
    """Draw the border of the chosen parts, while parts are picked or highlighted."""
    obj = context.active_object
    if not _shows_chosen(context) or faces_refusal(obj):
        return
    if not obj.visible_in_viewport_get(context.space_data):
        return
    shown = shown_parts(obj)
    if shown is None:
        return
    color = context.preferences.themes[0].view_3d.object_active
    for number in chosen_numbers(obj):
        _fill(obj, shown, number, _CHOSEN, 2)
        _outline(obj, shown, number, (*color, 1.0), _CHOSEN_WIDTH)


def _draw_hovered(context: bpy.types.Context) -> None:
    """Draw the part under the cursor, if the viewport shows its object."""
    picked = picking.current
    obj = None if picked is None else picked.object()
    if obj is None or not obj.visible_get(viewport=context.space_data):
        return
    shown = shown_parts(obj)
    if picked is not None and shown is not None:
        number = picked.number
        _fill(obj, shown, number, _HOVERED, 3)
        _outline(obj, shown, number, (1.0, 1.0, 1.0, 1.0), _HOVERED_WIDTH)


def _fill(
    obj: bpy.types.Object,
    shown: ShownParts,
    number: int,
    color: tuple[float, ...],
    layer: int,
) -> None:
    """Tint the faces of a part."""
    key = "faces", number
    if key not in shown.kept:
        places = shown.triangles_of(number)
        shown.kept[key] = _batch(clipped_shader(), "TRIS", places)
    shader, batch = shown.kept[key]
    shader.bind()
    shader.uniform_float("color", color)
    if batch is not None:
        draw = partial(draw_clipped, batch, shader, obj.matrix_world)
        _draw_nearer(obj, draw, layer)


def _outline(
    obj: bpy.types.Object,
    shown: ShownParts,
    number: int,
    color: tuple[float, ...],
    width: float,
) -> None:
    """Draw the edges around a part."""
    key, planes = ("border", number), planes_in(obj.matrix_world)
    kept = {} if len(planes) else shown.kept  # the region may be another one next
    if key not in kept:
        places = lines_within(shown.border_of(number), planes)
        shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
        kept[key] = _batch(shader, "LINES", places)
    shader, batch = kept[key]
    shader.bind()
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", width * bpy.context.preferences.system.ui_scale)
    shader.uniform_float("color", color)
    if batch is not None:
        _draw_nearer(obj, partial(batch.draw, shader), 4)


def _batch(shader: Any, kind: str, places: Float32Array) -> tuple[Any, Any]:
    """Return a shader of Blender's, and a batch for it; None if there is no place."""
    if not len(places):  # which `batch_for_shader` does not take
        return shader, None
    return shader, batch_for_shader(shader, kind, {"pos": places})


def _draw_nearer(obj: bpy.types.Object, draw: Callable[[], None], layer: int) -> None:
    """Draw in the space of an object, a little before its surface."""
    view = bpy.context.region_data
    projection = gpu.matrix.get_projection_matrix()
    nearer = _NEARER * layer
    if view.is_perspective:
        projection[2][3] *= 1.0 + nearer
    else:
        projection[2][3] += projection[2][2] * nearer * view.view_distance
    with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
        gpu.matrix.load_projection_matrix(projection)
        gpu.matrix.multiply_matrix(obj.matrix_world)
        draw()


def draw_name() -> None:
    """Draw the name of the part under the cursor beside it, in its window alone."""
    picked, region = picking.current, bpy.context.region
    if picked is None or picked.window != bpy.context.window.as_pointer():
        return
    part, x, y = picked.part(), picked.place[0] - region.x, picked.place[1] - region.y
    if part is None or not (0 <= x < region.width and 0 <= y < region.height):
        return
    scale = bpy.context.preferences.system.ui_scale
    colors = bpy.context.preferences.themes[0].user_interface.wcol_tooltip
    blf.size(0, _SIZE * scale)
    width, height = blf.dimensions(0, part.name)
    margin, beside = _MARGIN * scale, _BESIDE * scale
    left = min(x + beside, region.width - width - 2 * margin)
    low = max(y - beside - height, 0)
    _rectangle(left, low, width + 2 * margin, height + 2 * margin, colors.inner)
    blf.color(0, *colors.text[:3], 1.0)
    blf.position(0, left + margin, low + margin, 0)
    blf.draw(0, part.name)


def _rectangle(
    left: float, low: float, width: float, height: float, color: Any
) -> None:
    """Draw a rectangle in pixels."""
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    corners = [(left, low), (left + width, low), (left + width, low + height)]
    corners += [corners[0], corners[2], (left, low + height)]
    gpu.state.blend_set("ALPHA")
    shader.bind()
    shader.uniform_float("color", (*color[:3], 0.9))
    batch_for_shader(shader, "TRIS", {"pos": corners}).draw(shader)
    gpu.state.blend_set("NONE")
