"""Objects that fall as what their hulls are together, in Blender's own simulation."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ....core.errors import DecompositionError

# Custom property of objects, and of the collection of a simulation, made rigid by us.
_TAG = "wcd_rigid"


def make_rigid(
    obj: bpy.types.Object, hulls: Sequence[bpy.types.Object], kind: str
) -> None:
    """Make an object a compound of its hulls.

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
    if obj.rigid_body is not None and _TAG not in obj:
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
    ours = bpy.context.scene.rigidbody_world is None
    for each, shape in ((obj, "COMPOUND"), *((hull, "CONVEX_HULL") for hull in hulls)):
        with _on(each):
            bpy.ops.rigidbody.object_add(type=kind)
        each.rigid_body.collision_shape = shape
    obj[_TAG] = True
    if ours:
        bpy.context.scene.rigidbody_world.collection[_TAG] = True


def soften(obj: bpy.types.Object, hulls: Sequence[bpy.types.Object]) -> None:
    """Take back what `make_rigid` made, and a simulation of ours left empty."""
    if _TAG not in obj:
        return
    del obj[_TAG]
    for each in (obj, *hulls):
        if each.rigid_body is not None:
            with _on(each):
                bpy.ops.rigidbody.object_remove()
    for scene in bpy.data.scenes:
        bodies = scene.rigidbody_world and scene.rigidbody_world.collection
        if bodies and _TAG in bodies and not bodies.objects:
            with bpy.context.temp_override(scene=scene):
                bpy.ops.rigidbody.world_remove()
            bpy.data.collections.remove(bodies)


def _on(obj: bpy.types.Object) -> bpy.types.ContextTempOverride:
    """Return the context in which Blender's operators work on an object."""
    return bpy.context.temp_override(
        object=obj, active_object=obj, selected_objects=[obj]
    )
