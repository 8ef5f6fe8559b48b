"""Writes URDF: a robot of one link, or a link for each object."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from .....core.steps.arrays import FloatArray
from ....bridge.hulls.placed import Primitive, angles_of
from ..placed_meshes import DOUBLE, digits_of
from .bodies import GROUND, Body, Geometry


def write_urdf(path: Path, bodies: Sequence[Body], folder: str, each: bool) -> None:
    """Write a robot.

    Robots are trees of links. One body is a robot of one link. Several are links that
    joints of type "floating" connect to the ground, so that they move by themselves.

    Parameters
    ----------
    path : Path
        The file to write. The robot is called like it, without the ending.
    bodies : sequence of Body
    folder : str
        The folder of the meshes, relative to `path`.
    each : bool
        Whether the bodies hang on joints.
    """
    robot = ET.Element("robot", name=path.stem)
    # For MuJoCo: find the folder of the meshes, and keep a link that has no joint as a
    # body of its own. Other programs skip it.
    ET.SubElement(
        ET.SubElement(robot, "mujoco"),
        "compiler",
        strippath="false",
        fusestatic="false",
    )
    if each:
        ET.SubElement(robot, "link", name=GROUND)
    for body in bodies:
        _add_link(robot, body, folder)
    for body in bodies if each else ():
        joint = ET.SubElement(
            robot, "joint", name=f"{body.name} joint", type="floating"
        )
        ET.SubElement(joint, "parent", link=GROUND)
        ET.SubElement(joint, "child", link=body.name)
        _add_origin(joint, body.frame[:3, 3], body.frame[:3, :3])
    write_xml(path, robot)


def write_xml(path: Path, root: ET.Element) -> None:
    """Write an XML file."""
    ET.indent(root)
    ET.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def _add_link(robot: ET.Element, body: Body, folder: str) -> None:
    """Add a body with its mass and shapes."""
    link = ET.SubElement(robot, "link", name=body.name)
    inertial = ET.SubElement(link, "inertial")
    _add_origin(inertial, body.mass.center)
    ET.SubElement(inertial, "mass", value=f"{body.mass.mass:.9g}")
    rows = body.mass.inertia
    # Nine digits would lose the thin direction of a plate.
    tensor = {
        f"i{'xyz'[i]}{'xyz'[j]}": digits_of(rows[i, j : j + 1], DOUBLE)
        for i in range(3)
        for j in range(i, 3)
    }
    ET.SubElement(inertial, "inertia", tensor)
    for shape in body.visuals:
        visual = ET.SubElement(link, "visual", name=shape.name)
        _add_mesh(visual, shape, folder)
        material = ET.SubElement(visual, "material", name=shape.name)
        ET.SubElement(material, "color", rgba=digits_of(np.array(shape.color)))
    for shape in body.collisions:
        for number, each in enumerate(_pieces(shape.primitive), start=1):
            name = shape.name if number == 1 else f"{shape.name} end {number - 1}"
            _add_primitive(ET.SubElement(link, "collision", name=name), each)
        if shape.primitive is None:
            collision = ET.SubElement(link, "collision", name=shape.name)
            _add_mesh(collision, shape, folder)


def _pieces(primitive: Primitive | None) -> list[Primitive]:
    """Return the primitives that one is made of: URDF has no capsules.

    A cylinder and two balls at its ends are the same shape.
    """
    if primitive is None:
        return []
    if primitive.kind != "CAPSULE":
        return [primitive]
    half = primitive.rotation[:, 2] * primitive.sizes[2]
    ends = [
        replace(primitive, kind="SPHERE", center=primitive.center + end)
        for end in (half, -half)
    ]
    return [replace(primitive, kind="CYLINDER"), *ends]


def _add_primitive(element: ET.Element, primitive: Primitive) -> None:
    """Add the place and size of a primitive."""
    _add_origin(element, primitive.center, primitive.rotation)
    geometry = ET.SubElement(element, "geometry")
    radius, half = f"{primitive.sizes[0]:.9g}", primitive.sizes[2]
    if primitive.kind == "BOX":
        ET.SubElement(geometry, "box", size=digits_of(2 * primitive.sizes))
    elif primitive.kind == "SPHERE":
        ET.SubElement(geometry, "sphere", radius=radius)
    else:
        ET.SubElement(geometry, "cylinder", radius=radius, length=f"{2 * half:.9g}")


def _add_mesh(element: ET.Element, shape: Geometry, folder: str) -> None:
    """Add the file of a mesh, which is in the frame of the link."""
    geometry = ET.SubElement(element, "geometry")
    ET.SubElement(geometry, "mesh", filename=f"{folder}/{shape.file}")


def _add_origin(
    element: ET.Element, place: FloatArray, rotation: FloatArray | None = None
) -> None:
    """Add a place and a rotation matrix; without one, axes are those of the link."""
    angles = np.zeros(3) if rotation is None else angles_of(rotation)
    ET.SubElement(element, "origin", xyz=digits_of(place), rpy=digits_of(angles))
