"""What an object shows in place of its own mesh, and meshes made of that."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import bpy

from ..refusals import CONVERTIBLE
from ..stored.names import REALIZE_TAG
from ..views.node_modifiers import Nodes, is_view, new_node_group, remove_modifier


def shown_modifiers(obj: bpy.types.Object) -> list[bpy.types.Modifier]:
    """Return the modifiers that have an effect in the viewport, but for ours."""
    return [m for m in obj.modifiers if m.show_viewport and not is_view(m)]


def shows_keys(obj: bpy.types.Object) -> bool:
    """Return whether shape keys move the vertices of an object."""
    keys = getattr(obj.data, "shape_keys", None)  # point clouds have none
    if keys is None:
        return False
    # The mesh itself has the shape of the first one, whose value counts for nothing.
    others = [key for key in keys.key_blocks if key != keys.reference_key]
    if obj.show_only_shape_key:
        pinned = obj.active_shape_key
        return pinned in others and not pinned.mute
    if not keys.use_relative:  # they follow each other in time
        return bool(others)
    return any(key.value and not key.mute for key in others)


def differs(obj: bpy.types.Object | None) -> bool:
    """Return whether an object shows another mesh than its own."""
    if obj is None or obj.type != "MESH":
        return False
    posed = obj.parent is not None and obj.parent_type in {"ARMATURE", "LATTICE"}
    return bool(shown_modifiers(obj)) or shows_keys(obj) or posed


@contextmanager
def evaluated(
    obj: bpy.types.Object,
) -> Iterator[tuple[bpy.types.Object, bpy.types.Depsgraph]]:
    """Give the evaluated object, without the modifiers of ours that show parts.

    Instances that Geometry Nodes make are faces of its mesh. What its `to_mesh` makes
    is removed at the end.
    """
    with ExitStack() as back:
        back.callback(setattr, obj.modifiers, "active", obj.modifiers.active)
        for modifier in obj.modifiers:
            if modifier.show_viewport and is_view(modifier):
                modifier.show_viewport = False
                back.callback(setattr, modifier, "show_viewport", True)
        if any(each.type == "NODES" for each in shown_modifiers(obj)):
            back.callback(remove_modifier, obj, REALIZE_TAG)
            _realize_instances(obj)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        found = obj.evaluated_get(depsgraph)
        back.callback(found.to_mesh_clear)
        yield found, depsgraph


def _realize_instances(obj: bpy.types.Object) -> None:
    """Add a last modifier that makes faces of the instances of those before."""
    group = new_node_group("Realize Instances", REALIZE_TAG)
    nodes, link = Nodes(group), group.links.new
    given, out = nodes.add("NodeGroupInput", 0), nodes.add("NodeGroupOutput", 2)
    realize = nodes.add("GeometryNodeRealizeInstances", 1)
    link(given.outputs[0], realize.inputs[0])
    link(realize.outputs[0], out.inputs[0])
    modifier = obj.modifiers.new(group.name, "NODES")
    modifier.node_group = group
    modifier.use_pin_to_last = True  # as those that the user pinned
    last = len(obj.modifiers) - 1
    obj.modifiers.move(obj.modifiers.find(modifier.name), last)


def count_instances(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> int:
    """Return how many instances of other objects with faces an object shows."""
    kinds = {"MESH", *CONVERTIBLE}
    return sum(
        each.is_instance and each.parent.original == obj and each.object.type in kinds
        for each in depsgraph.object_instances
    )


def evaluated_copy(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return a new mesh of the file that equals what an object shows."""
    with evaluated(obj) as (found, depsgraph):
        return new_mesh_of(found, depsgraph)


def new_mesh_of(
    found: bpy.types.Object, depsgraph: bpy.types.Depsgraph | None
) -> bpy.types.Mesh:
    """Return a new mesh of the file that equals that of an evaluated object.

    Parameters
    ----------
    found : Object
        An evaluated object, or the object of an instance.
    depsgraph : Depsgraph or None
        With it, layers that Blender does not need to draw are kept, too. It must not
        be given for the object of an instance.
    """
    layers = {"preserve_all_data_layers": True, "depsgraph": depsgraph}
    return bpy.data.meshes.new_from_object(found, **layers if depsgraph else {})
