"""Exploded views: a modifier with a node group that moves parts apart."""

from __future__ import annotations

import math
from typing import Any

import bpy

from ....core.errors import DecompositionError
from ..stored.names import EXPLODE_TAG, PART_LAYER
from .node_modifiers import (
    NAMES,
    Nodes,
    new_node_group,
    remove_modifier,
    tagged_modifier,
)

# Largest distance of the slider; at 1, parts are twice as far from the center.
FARTHEST = 3.0
DISTANCE_HELP = "How much farther the parts are from the center of the shape"


def exploding(obj: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """Return the modifier that moves an object's parts apart, None without one.

    One whose node group lost its distance, or is gone, is none: it needs another group.
    """
    modifier = tagged_modifier(obj, EXPLODE_TAG)
    group = modifier and modifier.node_group
    return modifier if group and _distance_of(group) else None


def has_view(obj: bpy.types.Object) -> bool:
    """Return whether an object has such a modifier, also one that needs a group."""
    return tagged_modifier(obj, EXPLODE_TAG) is not None


def slider(modifier: bpy.types.NodesModifier) -> tuple[Any, str]:
    """Return the owner of the property that holds the distance, and its path."""
    identifier = _distance_of(modifier.node_group)
    if bpy.app.version >= (5, 2):  # inputs were custom properties before
        return getattr(modifier.properties.inputs, identifier), "value"
    return modifier, f'["{identifier}"]'


def explode(obj: bpy.types.Object, distance: float) -> None:
    """Move the parts of an object away from its center; its mesh stays as it is."""
    if not math.isfinite(distance):
        raise DecompositionError(f"Distance must be a number, not {distance}.")
    modifier = tagged_modifier(obj, EXPLODE_TAG)
    if modifier is None:
        modifier = obj.modifiers.new(NAMES[EXPLODE_TAG], "NODES")
    if exploding(obj) is None:
        modifier.node_group = _node_group()
    owner, path = slider(modifier)
    if path == "value":
        owner.value = distance
    else:
        owner[path[2:-2]] = distance
    obj.update_tag()


def implode(obj: bpy.types.Object) -> None:
    """Remove an exploded view, and its node group if nothing else uses it."""
    remove_modifier(obj, EXPLODE_TAG)


def _distance_of(group: bpy.types.NodeTree) -> str:
    """Return the identifier of the input that is the distance, '' without one."""
    sockets = (s for s in group.interface.items_tree if s.item_type == "SOCKET")
    kind = "INPUT", "NodeSocketFloat"
    found = (s.identifier for s in sockets if (s.in_out, s.socket_type) == kind)
    return next(found, "")


def _node_group() -> bpy.types.GeometryNodeTree:
    """Return the node group that all exploded views share; make it if missing."""
    for group in bpy.data.node_groups:
        if EXPLODE_TAG in group and group.library is None and _distance_of(group):
            return group
    group = new_node_group(NAMES[EXPLODE_TAG], EXPLODE_TAG)
    distance = group.interface.new_socket(
        "Distance", in_out="INPUT", socket_type="NodeSocketFloat"
    )
    distance.description = DISTANCE_HELP
    distance.subtype = "FACTOR"
    distance.min_value, distance.max_value = 0.0, FARTHEST
    _wire(group)
    return group


def _wire(group: bpy.types.GeometryNodeTree) -> None:
    """Fill the group: split the mesh along the seams, and move each part by its center.

    Every face of a part has the same offset. A point gets the mean offset of its faces,
    which is that of its part, because after the split no two parts share a point.
    """
    nodes = _MoveNodes(group)
    given, out = nodes.add("NodeGroupInput", 0), nodes.add("NodeGroupOutput", 6)
    part = nodes.add("GeometryNodeInputNamedAttribute", 0, data_type="INT")
    part.inputs["Name"].default_value = PART_LAYER
    seams = nodes.add("GeometryNodeMeshFaceSetBoundaries", 1)
    split = nodes.add("GeometryNodeSplitEdges", 4)
    move = nodes.add("GeometryNodeSetPosition", 5)
    link = group.links.new
    link(part.outputs["Attribute"], seams.inputs[0])
    link(given.outputs["Geometry"], split.inputs["Mesh"])
    link(seams.outputs[0], split.inputs["Selection"])
    link(split.outputs["Mesh"], move.inputs["Geometry"])
    link(move.outputs["Geometry"], out.inputs["Geometry"])
    of_part = nodes.center(part.outputs["Attribute"])
    apart = nodes.math("SUBTRACT", of_part, nodes.center(None))
    far = nodes.math("SCALE", apart, None)
    link(given.outputs["Distance"], far.node.inputs["Scale"])
    on_face = nodes.add(
        "GeometryNodeFieldOnDomain", 4, data_type="FLOAT_VECTOR", domain="FACE"
    )
    link(far, on_face.inputs[0])
    link(on_face.outputs[0], move.inputs["Offset"])


class _MoveNodes(Nodes):
    """Adds the nodes that find centers."""

    def center(self, group_id: Any) -> bpy.types.NodeSocket:
        """Return the center, by area, of the faces of each group, or of all."""
        area = self.add("GeometryNodeInputMeshFaceArea", 0)
        place = self.add("GeometryNodeInputPosition", 0)
        weighted = self.math("SCALE", place.outputs[0], None)
        self._group.links.new(area.outputs[0], weighted.node.inputs["Scale"])
        places = self._total("FLOAT_VECTOR", weighted, group_id)
        areas = self._total("FLOAT", area.outputs[0], group_id)
        return self.math("DIVIDE", places, areas)

    def math(self, operation: str, first: Any, second: Any) -> bpy.types.NodeSocket:
        """Return the result of an operation on vectors."""
        node = self.add("ShaderNodeVectorMath", 3, operation=operation)
        self._group.links.new(first, node.inputs[0])
        if second is not None:
            self._group.links.new(second, node.inputs[1])
        return node.outputs[0]

    def _total(self, kind: str, values: Any, group_id: Any) -> bpy.types.NodeSocket:
        """Return the sum of values over the faces of each group, or of all."""
        node = self.add("GeometryNodeAccumulateField", 2, data_type=kind, domain="FACE")
        self._group.links.new(values, node.inputs[0])
        if group_id is not None:
            self._group.links.new(group_id, node.inputs["Group ID"])
        return node.outputs["Total"]
