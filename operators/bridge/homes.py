"""Where an object is: in which collections, and whether in a view layer."""

from __future__ import annotations

import bpy


def homes_of(obj: bpy.types.Object) -> list[bpy.types.Collection]:
    """Return the collections that hold an object, without those of simulations.

    What belongs to the object goes there, too. What is in the collection of a
    simulation is a rigid body, and may be in no view.
    """
    worlds = [scene.rigidbody_world for scene in bpy.data.scenes]
    simulated = {
        collection
        for world in worlds
        if world
        for collection in (world.collection, world.constraints)
    }
    return [each for each in obj.users_collection if each not in simulated]


def objects_in(layer: bpy.types.ViewLayer) -> set[bpy.types.Object]:
    """Return the objects that a view layer has.

    Names do not tell: a linked object may have the same.
    """
    return set(layer.objects)


def new_collection(obj: bpy.types.Object, name: str) -> bpy.types.Collection:
    """Return a new collection in the first editable one that holds an object.

    It is in the scene's collection if a library holds all of the object's.
    """
    collection = bpy.data.collections.new(name)
    homes = [each for each in homes_of(obj) if each.is_editable]
    (homes[0] if homes else bpy.context.scene.collection).children.link(collection)
    return collection
