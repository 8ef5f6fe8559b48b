"""Which part is under the cursor."""

from __future__ import annotations

import math

import bpy
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree

from ..bridge.refusals import faces_refusal
from ..bridge.stored.names import HULL_TAG
from .shown_parts import shown_parts
from .viewports import ray_at, ray_within, shown_along, space_of

# How objects are drawn that rays go through.
_SEEN_THROUGH = {"WIRE", "BOUNDS"}
# How often a ray goes on behind what it hit at most: two times for each hull.
_MOST_HITS = 256
# How far behind a hit the ray goes on, as a share of the distance.
_BEHIND = 1e-5


def part_at(
    context: bpy.types.Context, region: bpy.types.Region, x: int, y: int
) -> tuple[bpy.types.Object, int] | None:
    """Return the object and the number of the part at a pixel, None if none is there.

    What hides a part hides it from here, too, except for collision hulls, which are
    around the very parts. In Edit Mode the objects that are edited hide each other, and
    other objects hide nothing. What is beyond a Clipping Region neither is seen nor
    hides anything.
    """
    space, ray = space_of(context, region), ray_at(region, x, y)
    return part_along(context, space, *ray, shown_along(space, region.data, *ray))


def make_tree() -> None:
    """Let Blender make the tree of the active object's mesh before a ray needs it."""
    obj = bpy.context.view_layer.objects.active
    if obj is not None and obj.type == "MESH" and obj.visible_get():
        graph = bpy.context.evaluated_depsgraph_get()
        obj.evaluated_get(graph).ray_cast(Vector(), Vector((0.0, 0.0, 1.0)))


def part_along(
    context: bpy.types.Context,
    space: bpy.types.SpaceView3D,
    origin: Vector,
    direction: Vector,
    within: tuple[float, float] = (0.0, math.inf),
) -> tuple[bpy.types.Object, int] | None:
    """Return the object and the number of the first part along a ray in the world.

    Nothing counts that is not `within` two distances from the origin.
    """
    if context.mode == "EDIT_MESH":
        hit = _first_edited(context, origin, direction, within)
    else:
        hit = _first_seen(context, space, origin, direction, within)
    if hit is None:
        return None
    obj, face = hit
    shown = shown_parts(obj)
    if shown is None or face >= len(shown.numbers) or faces_refusal(obj):
        return None
    return obj, int(shown.numbers[face])


def _first_seen(
    context: bpy.types.Context,
    space: bpy.types.SpaceView3D,
    origin: Vector,
    direction: Vector,
    within: tuple[float, float],
) -> tuple[bpy.types.Object, int] | None:
    """Return the first object along a ray in Object Mode, and its face there."""
    graph, (near, far) = context.evaluated_depsgraph_get(), within
    start = begin = origin + direction * near
    for _ in range(_MOST_HITS):
        hit, place, _normal, face, obj, matrix = context.scene.ray_cast(
            graph, start, direction
        )
        if not hit or (place - origin).length > far:
            return None
        obj = obj.original
        if _hides(obj, space):
            return (obj, face) if _is_itself(obj, matrix) else None
        step = _BEHIND * max((place - origin).length, 1e-3)
        owner = obj.parent if HULL_TAG in obj else None
        if owner is not None and owner.type == "MESH" and _hides(owner, space):
            found = _first_of(owner.evaluated_get(graph), begin, direction)
            # From behind the hull, the ray would miss what touches it from within.
            if found is not None and (found[0] - place).length <= step:
                return owner, found[1]
        start = place + direction * step
    return None


def _first_of(
    obj: bpy.types.Object, origin: Vector, direction: Vector
) -> tuple[Vector, int] | None:
    """Return where a ray in the world meets an evaluated object first, and the face."""
    hit, place, _normal, face = obj.ray_cast(*ray_within(obj, origin, direction))
    return (obj.matrix_world @ place, face) if hit else None


def _hides(obj: bpy.types.Object, space: bpy.types.SpaceView3D) -> bool:
    """Return whether an object hides what is behind it from a ray."""
    seen_through = HULL_TAG in obj or obj.display_type in _SEEN_THROUGH
    return not seen_through and obj.visible_in_viewport_get(space)


def _is_itself(obj: bpy.types.Object, matrix: Matrix) -> bool:
    """Return whether an object was hit where it is, and not an instance of it."""
    rows = zip(obj.matrix_world, matrix, strict=True)
    return all((mine - theirs).length < 1e-4 for mine, theirs in rows)


def _first_edited(
    context: bpy.types.Context,
    origin: Vector,
    direction: Vector,
    within: tuple[float, float],
) -> tuple[bpy.types.Object, int] | None:
    """Return the first object along a ray in Edit Mode, and its face there."""
    graph, (near, far), found = context.evaluated_depsgraph_get(), within, []
    for obj in context.objects_in_mode:
        shown = shown_parts(obj)
        if shown is None:
            continue
        if "tree" not in shown.kept:
            shown.kept["tree"] = BVHTree.FromObject(obj, graph)
        start, towards = ray_within(obj, origin + direction * near, direction)
        for _ in range(_MOST_HITS):
            place, _normal, face, _far = shown.kept["tree"].ray_cast(start, towards)
            if place is None:
                break
            distance = (obj.matrix_world @ place - origin).length
            if distance > far:
                break
            if not shown.hidden[face]:
                found.append((distance, obj.name, (obj, face)))
                break
            start = place + towards * _BEHIND * max(distance, 1e-3)
    return min(found)[2] if found else None
