"""The materials of parts: one for each number and name, shared by all objects.

A material is ours as long as it carries our tag and the name we gave it. One that the
user renames is the user's from then on, unless it is renamed in the table of parts.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

import bpy

from ..stored.identity import Identity, part_name
from .palette import part_color

_TAG = "wcd_part"
# The name of a material of ours that has not the one of its number.
_NAME = "wcd_name"
# What the tag says on the one material that shows the parts of any points.
_OF_POINTS = -1
# Blender numbers names that are taken: another file's "Part 01" comes in as
# "Part 01.001".
_NUMBERED = re.compile(r"\.\d{3,}$")


def _usual_name(tag: int) -> str:
    """Return the name that we give to a material of an unnamed part, or of points."""
    return "Parts of Points" if tag == _OF_POINTS else part_name(tag)


def _plain(name: str) -> str:
    """Return a name without the number that Blender gives to those that are taken."""
    return _NUMBERED.sub("", name)


def _name_of(material: bpy.types.Material) -> str:
    """Return the name that we gave to a material of ours, without a number."""
    return _plain(material.get(_NAME, _usual_name(material[_TAG])))


def is_ours(material: bpy.types.Material | None) -> bool:
    """Return whether a material is one that we made and the user did not rename."""
    if material is None or not isinstance(material.get(_TAG), int):
        return False
    return _plain(material.name) == _name_of(material)


def our_materials() -> list[bpy.types.Material]:
    """Return all materials of the file that are ours."""
    return [material for material in bpy.data.materials if is_ours(material)]


def part_materials(
    identities: Iterable[Identity], taken: list[str]
) -> list[bpy.types.Material]:
    """Return the materials of parts, making those that are missing.

    Those with the names `taken` are left to the slots that already show them.
    """
    free = _free_materials(taken)
    return [
        free.get((identity.number, _plain(identity.name))) or _make(identity)
        for identity in identities
    ]


def renamed_material(
    material: bpy.types.Material, identity: Identity
) -> bpy.types.Material:
    """Return a material that looks like one of ours and has the name of a part.

    Other objects may show the former, which is therefore not renamed itself.
    """
    copy = material.copy()
    _name_as(copy, identity)
    return copy


def points_material(color_layer: str, taken: list[str]) -> bpy.types.Material:
    """Return the material that shows a color attribute of points."""
    name = _usual_name(_OF_POINTS)
    material = _free_materials(taken).get((_OF_POINTS, name))
    if material is not None:
        return material
    material = _new(Identity(_OF_POINTS, name))
    nodes, links = material.node_tree.nodes, material.node_tree.links
    attribute = nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = color_layer
    attribute.location = (-250.0, 300.0)
    for node in nodes:
        if node.type == "BSDF_PRINCIPLED":
            links.new(attribute.outputs["Color"], node.inputs["Base Color"])
    return material


def _free_materials(taken: list[str]) -> dict[tuple[int, str], bpy.types.Material]:
    """Return materials of ours by tag and name, but for those with names `taken`."""
    free_ones: dict[tuple[int, str], bpy.types.Material] = {}
    for material in bpy.data.materials:
        free = material.library is None and material.name not in taken
        if free and is_ours(material):
            free_ones.setdefault((material[_TAG], _name_of(material)), material)
    return free_ones


def discard_unused(materials: Iterable[bpy.types.Material]) -> None:
    """Remove those materials of ours that nothing uses any more."""
    for material in materials:
        if material.users == 0 and material.library is None:
            bpy.data.materials.remove(material)


def _new(identity: Identity) -> bpy.types.Material:
    """Return a new material with our tag and name."""
    material = bpy.data.materials.new(identity.name)
    _name_as(material, identity)
    if material.node_tree is None:  # before Blender 5.0 nodes have to be asked for
        material.use_nodes = True
    return material


def _name_as(material: bpy.types.Material, identity: Identity) -> None:
    """Give a material our tag, and the name of a part."""
    material[_TAG] = identity.number
    material.name = identity.name
    if _plain(identity.name) != _usual_name(identity.number):
        material[_NAME] = identity.name
    elif _NAME in material:
        del material[_NAME]


def _make(identity: Identity) -> bpy.types.Material:
    material = _new(identity)
    color = part_color(identity.number)
    material.diffuse_color = color
    for node in material.node_tree.nodes:
        if node.type == "BSDF_PRINCIPLED":
            node.inputs["Base Color"].default_value = color
    return material
