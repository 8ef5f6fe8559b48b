"""The materials of parts: one for each number and name, shared by all objects.

A material is ours if it has our tag and the name that we gave it. A material that the
user renames becomes the user's, unless it is renamed in the table of parts.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

import bpy

from ..stored.identity import Identity, part_name
from ..stored.names import MATERIAL_NAME, MATERIAL_TAG
from .palette import part_color

# The number in the tag of the material that shows the parts of all point clouds.
_OF_POINTS = -1
# Blender adds a number to a name that is taken: "Part 01.001".
_NUMBERED = re.compile(r"\.\d{3,}$")


def _usual_name(tag: int) -> str:
    """Return the name of a material whose part has no name of its own, or of points."""
    return "Parts of Points" if tag == _OF_POINTS else part_name(tag)


def _plain(name: str) -> str:
    """Return a name without the number that Blender adds to a name that is taken."""
    return _NUMBERED.sub("", name)


def _name_of(material: bpy.types.Material) -> str:
    """Return the name that we gave to a material of ours, without a number."""
    return _plain(material.get(MATERIAL_NAME, _usual_name(material[MATERIAL_TAG])))


def is_ours(material: bpy.types.Material | None) -> bool:
    """Return whether a material is one that we made and the user did not rename."""
    if material is None or not isinstance(material.get(MATERIAL_TAG), int):
        return False
    return _plain(material.name) == _name_of(material)


def our_materials() -> list[bpy.types.Material]:
    """Return all materials of the file that are ours."""
    return [material for material in bpy.data.materials if is_ours(material)]


def part_materials(
    identities: Iterable[Identity], taken: list[str]
) -> list[bpy.types.Material]:
    """Return the materials of parts; make those that are missing.

    Materials with the names `taken` are not used, because they are in the user's slots.
    """
    free = _free_materials(taken)
    return [
        free.get((identity.number, _plain(identity.name))) or _make(identity)
        for identity in identities
    ]


def renamed_material(
    material: bpy.types.Material, identity: Identity
) -> bpy.types.Material:
    """Return a copy of a material of ours with the name of a part.

    The material itself keeps its name, because other objects may use it.
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
    """Return materials of ours by tag and name, without those named in `taken`."""
    free_ones: dict[tuple[int, str], bpy.types.Material] = {}
    for material in bpy.data.materials:
        free = material.library is None and material.name not in taken
        if free and is_ours(material):
            free_ones.setdefault((material[MATERIAL_TAG], _name_of(material)), material)
    return free_ones


def discard_unused(materials: Iterable[bpy.types.Material]) -> None:
    """Remove materials of ours that nothing uses any more."""
    for material in materials:
        if material.users == 0 and material.library is None:
            bpy.data.materials.remove(material)


def _new(identity: Identity) -> bpy.types.Material:
    """Return a new material with our tag and name."""
    material = bpy.data.materials.new(identity.name)
    _name_as(material, identity)
    if material.node_tree is None:  # Blender before 5.0 makes nodes on request only
        material.use_nodes = True
    return material


def _name_as(material: bpy.types.Material, identity: Identity) -> None:
    """Give a material our tag, and the name of a part."""
    material[MATERIAL_TAG] = identity.number
    material.name = identity.name
    if _plain(identity.name) != _usual_name(identity.number):
        material[MATERIAL_NAME] = identity.name
    elif MATERIAL_NAME in material:
        del material[MATERIAL_NAME]


def _make(identity: Identity) -> bpy.types.Material:
    material = _new(identity)
    color = part_color(identity.number)
    material.diffuse_color = color
    for node in material.node_tree.nodes:
        if node.type == "BSDF_PRINCIPLED":
            node.inputs["Base Color"].default_value = color
    return material
