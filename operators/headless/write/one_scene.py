"""The scene that is written: all that is worked on, shown, and what that hangs on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager

import bpy

from ...bridge.hulls.listed import is_hull
from ...bridge.read.shape import has_place
from ...bridge.refusals import WORKED_ON
from ..current_file import mesh_objects, objects_in_view_layers

# Name of the scene of the user while another one has its name.
_FORMER = ".former scene"


def written_meshes() -> list[bpy.types.Object]:
    """Return the meshes and point clouds to be written: those that have a place."""
    return [obj for obj in mesh_objects() if has_place(obj)]


@contextmanager
def one_scene(
    hulls: Sequence[bpy.types.Object] = (),
) -> Iterator[Sequence[bpy.types.Object]]:
    """Bring all objects into one scene, for exporters; take it back at the end.

    Yields them: the objects of all view layers, hidden ones too, and the empties and
    armatures that they hang on. Objects of excluded collections are left out, those
    whose place is not a number, and hulls of an earlier run: all but `hulls`.
    """
    scene, window = bpy.context.scene, bpy.context.window
    layer, name = window.view_layer, scene.name
    objects = _written(scene, hulls)
    hidden = [obj for obj in objects if obj.hide_viewport]
    copy = _copy_with(scene, objects)
    try:
        for obj in hidden:
            obj.hide_viewport = False
        scene.name = _FORMER
        copy.name = name  # files may have it
        window.scene = copy
        # The copy also knows what is hidden by its eye. To set it takes milliseconds.
        for obj in [obj for obj in objects if obj.hide_get()]:
            obj.hide_set(False)
        bpy.context.view_layer.update()
        yield objects
    finally:
        window.scene, window.view_layer = scene, layer
        bpy.data.scenes.remove(copy)
        scene.name = name
        for obj in hidden:
            obj.hide_viewport = True
        bpy.context.view_layer.update()


def _written(
    scene: bpy.types.Scene, hulls: Sequence[bpy.types.Object]
) -> list[bpy.types.Object]:
    """Return the objects to be written, those of a scene first, in its order."""
    chosen = set(hulls)
    seen = objects_in_view_layers()
    written = {obj for obj in seen if obj in chosen or not is_hull(obj)}
    written |= set(_needed(written))
    scenes = [scene, *bpy.data.scenes]
    every = dict.fromkeys(obj for each in scenes for obj in each.objects)
    return [obj for obj in every if obj in written and has_place(obj)]


def _needed(objects: Iterable[bpy.types.Object]) -> Iterator[bpy.types.Object]:
    """Yield what objects hang on: parents, and armatures; no other meshes."""
    for obj in objects:
        above = [
            obj.parent,
            *(each.object for each in obj.modifiers if each.type == "ARMATURE"),
        ]
        found = [each for each in above if each and each.type not in WORKED_ON]
        yield from found
        yield from _needed(found)


def _copy_with(
    scene: bpy.types.Scene, objects: Sequence[bpy.types.Object]
) -> bpy.types.Scene:
    """Return a copy of a scene, with its units and frame, that has these objects."""
    copy = scene.copy()
    for child in list(copy.collection.children):
        copy.collection.children.unlink(child)
    for obj in list(copy.collection.objects):
        copy.collection.objects.unlink(obj)
    for obj in objects:
        copy.collection.objects.link(obj)
    return copy
