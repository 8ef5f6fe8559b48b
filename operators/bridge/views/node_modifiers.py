"""Modifiers of ours that show parts: node groups with a tag, one modifier of a kind."""

from __future__ import annotations

import bpy

from ....core.errors import DecompositionError
from ..stored.names import EXPLODE_TAG, ISOLATE_TAG

# What modifiers and node groups with a tag are called.
NAMES = {EXPLODE_TAG: "Exploded View", ISOLATE_TAG: "Isolated Parts"}


def is_view(modifier: bpy.types.Modifier) -> bool:
    """Return whether a modifier only shows parts, and says nothing of the shape."""
    return any(_has_tag(modifier, tag) for tag in NAMES)


def tagged_modifier(obj: bpy.types.Object, tag: str) -> bpy.types.NodesModifier | None:
    """Return the modifier of an object whose node group has a tag, None without one.

    If there is none, it is one with our name whose node group is gone.
    """
    found = [each for each in obj.modifiers if _has_tag(each, tag)]
    return max(found, key=lambda each: each.node_group is not None, default=None)


def remove_modifier(obj: bpy.types.Object, tag: str) -> None:
    """Remove a modifier of ours, and its node group if nothing else uses it.

    Raises
    ------
    DecompositionError
        In Edit Mode, if there is one: undo there would not bring it back. The mesh may
        be in Edit Mode on another object.
    """
    modifier = tagged_modifier(obj, tag)
    if modifier is None:
        return
    if obj.mode != "OBJECT" or obj.data.is_editmode:
        raise DecompositionError(
            f"{modifier.name} is a modifier, which Edit Mode cannot bring back on"
            " undo; switch to Object Mode first."
        )
    group = modifier.node_group
    obj.modifiers.remove(modifier)
    if group is not None and _is_unused(group):
        bpy.data.node_groups.remove(group)


def remove_views(obj: bpy.types.Object) -> None:
    """Remove all modifiers of ours from an object, and node groups without any.

    Those of a library stay: on an override they would be there again in the file.
    """
    for tag in NAMES:
        modifier = tagged_modifier(obj, tag)
        if modifier is None:
            continue
        # Blender says so of modifiers of objects that were appended, too.
        if obj.override_library is None or not modifier.is_override_data:
            remove_modifier(obj, tag)
    discard_views()


def discard_views() -> None:
    """Remove node groups of ours whose object is gone, deleted or joined."""
    for group in bpy.data.node_groups[:]:
        if any(tag in group for tag in NAMES) and _is_unused(group):
            bpy.data.node_groups.remove(group)


def new_node_group(name: str, tag: str) -> bpy.types.GeometryNodeTree:
    """Return a new node group for a modifier, with a tag and without nodes."""
    group = bpy.data.node_groups.new(name, "GeometryNodeTree")
    group[tag] = True
    group.is_modifier = True
    for in_out in ("INPUT", "OUTPUT"):
        group.interface.new_socket(
            "Geometry", in_out=in_out, socket_type="NodeSocketGeometry"
        )
    return group


class Nodes:
    """Adds nodes to a group, in columns from left to right."""

    def __init__(self, group: bpy.types.GeometryNodeTree) -> None:
        self._group = group
        self._heights: dict[int, float] = {}

    def add(self, kind: str, column: int, **settings: str) -> bpy.types.Node:
        """Return a new node."""
        node = self._group.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        height = self._heights.get(column, 0.0)
        node.location = 220.0 * column, -height
        self._heights[column] = height + 220.0
        return node


def _is_unused(group: bpy.types.NodeTree) -> bool:
    """Return whether nothing uses a node group, and it may be removed."""
    return bool(group.users == 0 and group.library is None)


def _has_tag(modifier: bpy.types.Modifier, tag: str) -> bool:
    """Return whether a modifier is one of ours with this tag."""
    if modifier.type != "NODES":
        return False
    group = modifier.node_group
    return bool(modifier.name == NAMES.get(tag) if group is None else tag in group)
