"""Where the slider of an exploded view is, for panels and operators."""

from __future__ import annotations

from typing import Any

import bpy

# Custom property of the node group that makes exploded views.
TAG = "wcd_explode"


def exploding(obj: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """Return the modifier that moves an object's parts apart, None without one."""
    for modifier in obj.modifiers:
        if modifier.type == "NODES" and TAG in (modifier.node_group or ()):
            return modifier
    return None


def slider(modifier: bpy.types.NodesModifier) -> tuple[Any, str]:
    """Return what has the distance as a property, and the property's path."""
    sockets = modifier.node_group.interface.items_tree
    identifier = next(
        socket.identifier
        for socket in sockets
        if socket.in_out == "INPUT" and socket.socket_type == "NodeSocketFloat"
    )
    if bpy.app.version >= (5, 2):  # inputs were custom properties before
        return getattr(modifier.properties.inputs, identifier), "value"
    return modifier, f'["{identifier}"]'
