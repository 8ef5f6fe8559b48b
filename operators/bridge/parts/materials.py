"""The materials of parts: each object has its own, one for each part.

Hulls that are of no part share theirs with those of other objects: files may have
thousands. A material is ours if it has our tag and the name that we gave it. A material
that the user renames becomes the user's, unless it is renamed in the list of parts.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import bpy
import numpy as np

from ..stored.identity import (
    Color,
    Identity,
    has_name,
    part_name,
    plain_name,
    rgb,
)
from ..stored.names import COLOR_LAYER, MATERIAL_NAME, MATERIAL_TAG
from .palette import usual_color

# The number in the tag of the material that shows the parts of all point clouds. Below
# are those of hulls: the first, the second and so on of an object.
_OF_POINTS, _OF_HULL = -1, -2
_POINTS_NAME = "Parts of Points"


def name_of(material: bpy.types.Material) -> str:
    """Return the name of the part, or hull, that a material of ours was made for."""
    return str(material.get(MATERIAL_NAME, _usual_name(material[MATERIAL_TAG])))


def _usual_name(tag: int) -> str:
    """Return the name of a material of ours that nobody named otherwise."""
    if tag == _OF_POINTS:
        return _POINTS_NAME
    return part_name(tag) if tag >= 0 else f"Hull {_OF_HULL - tag + 1:02d}"


def is_ours(material: bpy.types.Material | None) -> bool:
    """Return whether a material is one that we made and the user did not rename."""
    if material is None or not isinstance(material.get(MATERIAL_TAG), int):
        return False
    return has_name(material.name, name_of(material))


def is_of_part(material: bpy.types.Material | None) -> bool:
    """Return whether a material of ours is that of a part."""
    return material is not None and is_ours(material) and material[MATERIAL_TAG] >= 0


def our_materials() -> list[bpy.types.Material]:
    """Return all materials of the file that are ours."""
    return [material for material in bpy.data.materials if is_ours(material)]


def color_of(material: bpy.types.Material) -> Color:
    """Return the color of a material in Solid shading, linear."""
    return rgb(material.diffuse_color)


def own_materials(
    identities: Iterable[Identity],
    sources: Mapping[int, bpy.types.Material | None],
    hulls: Iterable[bpy.types.Object] = (),
) -> list[bpy.types.Material]:
    """Return materials for the parts of one object.

    Parameters
    ----------
    identities : iterable of Identity
    sources : mapping of int to bpy.types.Material or None
        The materials that parts had, by their numbers. One is used again if nothing
        else uses it; otherwise it is copied, so that no two objects share one.
    hulls : iterable of bpy.types.Object, optional
        The hulls of the object: they share the materials of its parts.
    """
    materials = []
    worn = [each for mesh in {hull.data for hull in hulls} for each in mesh.materials]
    for identity in identities:
        source = sources.get(identity.number)
        if source is None or not is_ours(source):
            material = _new(identity.name)
            recolor(material, identity.color)
        elif source.users == worn.count(source) and source.library is None:
            material = source
        else:
            material = source.copy()
        _tag(material, identity)
        materials.append(material)
    return materials


def none_missing(
    identities: Iterable[Identity], materials: Sequence[bpy.types.Material | None]
) -> list[bpy.types.Material]:
    """Return the materials of parts, new ones in place of those the user removed."""
    return [
        material or own_materials([identity], {})[0]
        for identity, material in zip(identities, materials, strict=True)
    ]


def own_material(
    material: bpy.types.Material, identity: Identity
) -> bpy.types.Material:
    """Give a material the name and color of a part, and return it.

    A material that something else uses, too, stays as it is, and is copied.
    """
    if material.users > 1 or material.library is not None:
        material = material.copy()
    _tag(material, identity)
    recolor(material, identity.color)
    return material


def points_material(cloud: bpy.types.ID) -> bpy.types.Material:
    """Return the material that shows the colors of points.

    All point clouds share it. What is in the slots of a cloud already is the user's.
    """
    for material in _shared(_OF_POINTS, bpy.data.materials):
        if material.name not in cloud.materials:
            return material
    material = _new(_POINTS_NAME)
    material[MATERIAL_TAG] = _OF_POINTS
    nodes, links = material.node_tree.nodes, material.node_tree.links
    attribute = nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = COLOR_LAYER
    attribute.location = (-250.0, 300.0)
    for shader in _shaders(material):
        links.new(attribute.outputs["Color"], shader.inputs["Base Color"])
    return material


def hull_material(row: int) -> bpy.types.Material:
    """Return the material of a hull that is of no part: the same for all objects.

    Parameters
    ----------
    row : int
        Place of the hull among those of its object, from 0. It has the color that the
        part with this number has at first, or what the user gave it since.
    """
    tag = _OF_HULL - row
    name = _usual_name(tag)
    named = bpy.data.materials.get((name, None))
    for material in _shared(tag, [named, *bpy.data.materials] if named else ()):
        if material.diffuse_color[3] == 1.0:  # others are copies, seen through
            return material
    material = _new(name)
    material[MATERIAL_TAG] = tag
    recolor(material, usual_color(row))
    return material


def _shared(
    tag: int, materials: Iterable[bpy.types.Material]
) -> Iterator[bpy.types.Material]:
    """Yield those of some materials that are ours, have a tag and are in no library."""
    for material in materials:
        tagged = is_ours(material) and material[MATERIAL_TAG] == tag
        if tagged and material.library is None:
            yield material


def discard_unused(materials: Iterable[bpy.types.Material]) -> None:
    """Remove materials of ours that nothing uses any more."""
    for material in dict.fromkeys(materials):  # the user may give one to more slots
        if material.users == 0 and material.library is None:
            bpy.data.materials.remove(material)


def discard(objects: Sequence[bpy.types.Object]) -> None:
    """Remove mesh objects, then the meshes and materials of ours without users."""
    meshes = {obj.data for obj in objects}
    worn = {material for mesh in meshes for material in mesh.materials}
    worn |= {slot.material for obj in objects for slot in obj.material_slots}
    materials = set(filter(is_ours, worn))
    for obj in objects:
        bpy.data.objects.remove(obj)
    for mesh in meshes:
        if mesh.users == 0:
            bpy.data.meshes.remove(mesh)
    discard_unused(materials)


def recolor(material: bpy.types.Material, color: Color) -> None:
    """Give a material a color, in Solid shading and in renders."""
    if np.allclose(material.diffuse_color[:3], color, atol=1e-6):
        return  # an artist may have given renders another color
    material.diffuse_color = (*color, 1.0)
    for shader in _shaders(material):
        shader.inputs["Base Color"].default_value = (*color, 1.0)


def _shaders(material: bpy.types.Material) -> list[bpy.types.Node]:
    """Return the nodes that have the color of a material."""
    nodes = material.node_tree.nodes if material.node_tree else ()
    return [node for node in nodes if node.type == "BSDF_PRINCIPLED"]


def _new(name: str) -> bpy.types.Material:
    """Return a new material with nodes."""
    material = bpy.data.materials.new(name)
    if material.node_tree is None:  # Blender before 5.0 makes nodes on request only
        material.use_nodes = True
    return material


def _tag(material: bpy.types.Material, identity: Identity) -> None:
    """Give a material our tag, and the name of a part."""
    # A name that was cut stays until the part gets another one.
    named = is_ours(material) and name_of(material) == identity.name
    material[MATERIAL_TAG] = identity.number
    material[MATERIAL_NAME] = identity.name
    if not named and plain_name(material.name) != plain_name(identity.name):
        material.name = identity.name
