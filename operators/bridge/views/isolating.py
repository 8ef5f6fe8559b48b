"""Isolated parts in Object Mode: a modifier that leaves out the faces of the others.

Blender draws hidden faces in Object Mode, so flags of the mesh would not do. The
modifier is for viewports only, and renders show the whole object. So do viewports once
none of these parts is left.
"""

from __future__ import annotations

from collections.abc import Iterable

import bpy

from ..stored.names import ISOLATE_TAG, PART_LAYER
from .node_modifiers import (
    NAMES,
    Nodes,
    new_node_group,
    remove_modifier,
    tagged_modifier,
)


def isolating(obj: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """Return the modifier that isolates parts of an object, None without one."""
    return tagged_modifier(obj, ISOLATE_TAG)


def isolate(obj: bpy.types.Object, numbers: Iterable[int]) -> None:
    """Show only the parts with these numbers; the mesh itself stays as it is."""
    end_isolation(obj)
    group = new_node_group(NAMES[ISOLATE_TAG], ISOLATE_TAG)
    _wire(group, numbers)
    modifier = obj.modifiers.new(NAMES[ISOLATE_TAG], "NODES")
    modifier.node_group = group
    modifier.show_render = modifier.show_in_editmode = False


def end_isolation(obj: bpy.types.Object) -> None:
    """Show all parts again."""
    remove_modifier(obj, ISOLATE_TAG)


def _wire(group: bpy.types.GeometryNodeTree, numbers: Iterable[int]) -> None:
    """Fill the group: delete the faces of all other parts, if some faces are left."""
    nodes, link = Nodes(group), group.links.new
    given, out = nodes.add("NodeGroupInput", 0), nodes.add("NodeGroupOutput", 6)
    part = nodes.add("GeometryNodeInputNamedAttribute", 0, data_type="INT")
    part.inputs["Name"].default_value = PART_LAYER
    delete = nodes.add("GeometryNodeDeleteGeometry", 3, domain="FACE")
    link(given.outputs["Geometry"], delete.inputs["Geometry"])
    left = nodes.add("GeometryNodeAttributeDomainSize", 4, component="MESH")
    shown = nodes.add("GeometryNodeSwitch", 5, input_type="GEOMETRY")
    link(delete.outputs["Geometry"], left.inputs["Geometry"])
    link(left.outputs["Face Count"], shown.inputs["Switch"])
    link(given.outputs["Geometry"], shown.inputs["False"])
    link(delete.outputs["Geometry"], shown.inputs["True"])
    link(shown.outputs["Output"], out.inputs["Geometry"])
    another = None
    for number in numbers:
        differs = nodes.add(
            "FunctionNodeCompare", 1, data_type="INT", operation="NOT_EQUAL"
        )
        first, second = (s for s in differs.inputs if s.enabled and s.type == "INT")
        link(part.outputs["Attribute"], first)
        second.default_value = number
        both = nodes.add("FunctionNodeBooleanMath", 2, operation="AND")
        both.inputs[0].default_value = both.inputs[1].default_value = True
        if another is not None:
            link(another, both.inputs[0])
        link(differs.outputs[0], both.inputs[1])
        another = both.outputs[0]
    if another is not None:
        link(another, delete.inputs["Selection"])
