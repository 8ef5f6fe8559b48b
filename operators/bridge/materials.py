"""The materials of parts: one for each part number, shared by all objects.

A material is ours as long as it carries our tag and the name we gave it. One that the
user renames is the user's from then on.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

import bpy

from .palette import part_color

_TAG = "wcd_part"
# What the tag says on the one material that shows the parts of any points.
_OF_POINTS = -1
# Blender numbers names that are taken: another file's "Part 01" comes in as
# "Part 01.001".
_NUMBERED = re.compile(r"\.\d{3,}$")


def part_name(index: int) -> str:
    """Return the name of a part, counted from 0, as the user sees it."""
    return f"Part {index + 1:02d}"


def _name(tag: int) -> str:
    """Return the name that we give to a material."""
    return "Parts of Points" if tag == _OF_POINTS else part_name(tag)


def is_ours(material: bpy.types.Material | None) -> bool:
    """Return whether a material is one that we made and the user did not rename."""
    if material is None or not isinstance(material.get(_TAG), int):
        return False
    return _NUMBERED.sub("", material.name) == _name(material[_TAG])


def our_materials() -> list[bpy.types.Material]:
    """Return all materials of the file that are ours."""
    return [material for material in bpy.data.materials if is_ours(material)]


def part_materials(n_parts: int, taken: list[str]) -> list[bpy.types.Material]:
    """Return the materials of the first parts, making those that are missing.

    Those with the names `taken` are left to the slots that already show them.
    """
    by_index = _free_materials(taken)
    return [by_index.get(index) or _make(index) for index in range(n_parts)]


def points_material(color_layer: str, taken: list[str]) -> bpy.types.Material:
    """Return the material that shows a color attribute of points."""
    material = _free_materials(taken).get(_OF_POINTS)
    if material is not None:
        return material
    material = _new(_OF_POINTS)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    attribute = nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = color_layer
    attribute.location = (-250.0, 300.0)
    for node in nodes:
        if node.type == "BSDF_PRINCIPLED":
            links.new(attribute.outputs["Color"], node.inputs["Base Color"])
    return material


def _free_materials(taken: list[str]) -> dict[int, bpy.types.Material]:
    """Return materials of ours by their tags, but for those with names `taken`."""
    by_index: dict[int, bpy.types.Material] = {}
    for material in bpy.data.materials:
        free = material.library is None and material.name not in taken
        if free and is_ours(material):
            by_index.setdefault(material[_TAG], material)
    return by_index


def discard_unused(materials: Iterable[bpy.types.Material]) -> None:
    """Remove those materials of ours that nothing uses any more."""
    for material in materials:
        if material.users == 0 and material.library is None:
            bpy.data.materials.remove(material)


def _new(tag: int) -> bpy.types.Material:
    """Return a new material with our tag and name."""
    material = bpy.data.materials.new(_name(tag))
    material[_TAG] = tag
    if material.node_tree is None:  # before Blender 5.0 nodes have to be asked for
        material.use_nodes = True
    return material


def _make(index: int) -> bpy.types.Material:
    material = _new(index)
    color = part_color(index)
    material.diffuse_color = color
    for node in material.node_tree.nodes:
        if node.type == "BSDF_PRINCIPLED":
            node.inputs["Base Color"].default_value = color
    return material
