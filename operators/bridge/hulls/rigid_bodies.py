"""Make an object a rigid body of Blender's simulation, in the shape of its hulls."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import bpy

from ....core.errors import DecompositionError
from ..stored.names import RIGID_TAG


def make_rigid(
    obj: bpy.types.Object, hulls: Sequence[bpy.types.Object], kind: str
) -> None:
    """Make an object a rigid body that is the compound of its hulls.

    Parameters
    ----------
    obj : Object
    hulls : sequence of Object
        Its children.
    kind : {'ACTIVE', 'PASSIVE'}
        Whether it falls, or stays where it is.

    Raises
    ------
    DecompositionError
        If the object is a rigid body of the user's, or cannot be one.
    """
    if obj.rigid_body is not None and RIGID_TAG not in obj:
        raise DecompositionError(
            f"{obj.name} is a rigid body already; remove that before its hulls get it."
        )
    unseen = [
        o.name for o in (obj, *hulls) if o.name not in bpy.context.view_layer.objects
    ]
    if unseen:
        raise DecompositionError(
            f"{unseen[0]} is not in the view layer; rigid bodies have to be."
        )
    soften(obj, hulls)
    scene = bpy.context.scene
    ours = scene.rigidbody_world is None
    for each, shape in ((obj, "COMPOUND"), *((hull, "CONVEX_HULL") for hull in hulls)):
        with _on(each, scene):
            bpy.ops.rigidbody.object_add(type=kind)
        each.rigid_body.collision_shape = shape
    obj[RIGID_TAG] = True
    if ours:
        scene.rigidbody_world.collection[RIGID_TAG] = True


def soften(obj: bpy.types.Object, hulls: Sequence[bpy.types.Object]) -> None:
    """Undo `make_rigid`."""
    if RIGID_TAG not in obj:
        return
    del obj[RIGID_TAG]
    body = obj.rigid_body
    ours = body is not None and body.collision_shape == "COMPOUND"
    for each in (obj, *hulls) if ours else hulls:  # else it was replaced
        if each.rigid_body is not None:
            with _on(each, _scene_of(each)):
                bpy.ops.rigidbody.object_remove()
    remove_simulation()


def remove_simulation() -> None:
    """Remove the simulation that we made in a scene if nothing is left in it."""
    for scene, bodies in _simulations():
        if RIGID_TAG in bodies and not bodies.objects:
            with bpy.context.temp_override(**_within(scene)):
                bpy.ops.rigidbody.world_remove()
            bpy.data.collections.remove(bodies)


def _simulations() -> Iterator[tuple[bpy.types.Scene, bpy.types.Collection]]:
    """Yield the scenes with a simulation, and the rigid bodies in each."""
    for scene in bpy.data.scenes:  # some may share what the caller removes
        world = scene.rigidbody_world
        if world and world.collection:
            yield scene, world.collection


def _scene_of(body: bpy.types.Object) -> bpy.types.Scene:
    """Return the scene in whose simulation a rigid body is, which may be another."""
    homes = body.users_collection
    scenes = (scene for scene, bodies in _simulations() if bodies in homes)
    return next(scenes, bpy.context.scene)


def _within(scene: bpy.types.Scene) -> dict[str, Any]:
    """Return what tells Blender's operators to work in a scene.

    They crash where the scene is one and the view layer another's.
    """
    if scene == bpy.context.scene:
        return {}
    return {"scene": scene, "view_layer": scene.view_layers[0]}


def _on(obj: bpy.types.Object, scene: bpy.types.Scene) -> bpy.types.ContextTempOverride:
    """Return the context in which Blender's operators work on an object in a scene."""
    return bpy.context.temp_override(
        object=obj,
        active_object=obj,
        selected_objects=[obj],
        **_within(scene),
    )
