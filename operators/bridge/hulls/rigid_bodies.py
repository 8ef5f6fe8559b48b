"""Make an object a rigid body of Blender's simulation, in the shape of its hulls."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any

import bpy

from ....core.errors import DecompositionError
from ..homes import objects_in
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
    if obj.override_library and obj.override_library.is_system_override:
        raise DecompositionError(
            f"{obj.name} is an override of a library that cannot be edited; make it"
            " local first (Object > Relations > Make Local)."
        )
    there = objects_in(bpy.context.view_layer)
    unseen = [each.name for each in (obj, *hulls) if each not in there]
    if unseen:
        raise DecompositionError(
            f"{unseen[0]} is not in the view layer; rigid bodies have to be."
        )
    soften(obj, hulls)
    with ExitStack() as on_error:
        obj[RIGID_TAG] = True
        on_error.callback(soften, obj, hulls)
        _add_body(obj, kind, "COMPOUND")
        for hull in hulls:
            _add_body(hull, kind, "CONVEX_HULL")
        on_error.pop_all()


def soften(obj: bpy.types.Object, hulls: Sequence[bpy.types.Object]) -> None:
    """Undo `make_rigid`."""
    if RIGID_TAG not in obj:
        return
    body = obj.rigid_body
    ours = body is not None and body.collision_shape == "COMPOUND"
    for each in (*hulls, obj) if ours else hulls:  # else it was replaced
        if each.rigid_body is not None:
            with _on(each, _scene_of(each)):
                bpy.ops.rigidbody.object_remove()
    del obj[RIGID_TAG]  # last: what fails on the way can be tried again
    remove_simulation()


def remove_simulation() -> None:
    """Remove the simulation that we made in a scene if nothing is left in it.

    It stays if the user has constraints in it or changed its settings.
    """
    for scene, bodies in _simulations():
        if RIGID_TAG in bodies and not _is_used(scene.rigidbody_world):
            with bpy.context.temp_override(**_within(scene)):
                bpy.ops.rigidbody.world_remove()
            bpy.data.collections.remove(bodies)


def _add_body(obj: bpy.types.Object, kind: str, shape: str) -> None:
    """Make an object a rigid body; note on a simulation made for it that it is ours."""
    scene = bpy.context.scene
    ours = scene.rigidbody_world is None
    with _on(obj, scene):
        bpy.ops.rigidbody.object_add(type=kind)
    obj.rigid_body.collision_shape = shape
    if ours:
        world = scene.rigidbody_world
        world.collection[RIGID_TAG] = _settings_of(world)


def _is_used(world: bpy.types.RigidBodyWorld) -> bool:
    """Return whether a simulation of ours has bodies, or something of the user's."""
    held = [each for each in (world.collection, world.constraints) if each]
    if any(each.all_objects for each in held):
        return True
    noted: dict[str, str] = getattr(world.collection[RIGID_TAG], "to_dict", dict)()
    now = _settings_of(world)  # another version of Blender may have others
    return any(now.get(name, value) != value for name, value in noted.items())


def _settings_of(world: bpy.types.RigidBodyWorld) -> dict[str, str]:
    """Return the settings of a simulation that users can change, as texts by name."""
    weights, cache = world.effector_weights, world.point_cache
    owners = {"": world, "effector_weights.": weights, "point_cache.": cache}
    settings = {
        group + each.identifier: repr(getattr(owner, each.identifier))
        for group, owner in owners.items()
        for each in owner.bl_rna.properties
        if not each.is_readonly
    }
    del settings["collection"], settings["constraints"]  # what they hold counts
    return settings


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


@contextmanager
def _on(obj: bpy.types.Object, scene: bpy.types.Scene) -> Iterator[None]:
    """Let Blender's operators work on an object in a scene.

    They refuse objects that are disabled in viewports, so this one is not meanwhile.
    """
    disabled = obj.hide_viewport
    if disabled:
        obj.hide_viewport = False
    try:
        with bpy.context.temp_override(
            object=obj, active_object=obj, selected_objects=[obj], **_within(scene)
        ):
            yield
    finally:
        if disabled:
            obj.hide_viewport = True
