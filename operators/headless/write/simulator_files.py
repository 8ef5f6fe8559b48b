"""Writes the files that tell simulators of hulls: URDF, and MuJoCo's MJCF."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path


def write_urdf(path: Path, model: str, meshes: dict[str, str]) -> None:
    """Write a robot of one link that has the hulls for collision.

    Parameters
    ----------
    path : Path
        The file to write.
    model : str
        Name of the model.
    meshes : dict of str
        The .obj file of each hull, by the hull's name; relative to `path`.
    """
    robot = ET.Element("robot", name=model)
    # Without this MuJoCo ignores the folder of the meshes; other programs skip it.
    ET.SubElement(ET.SubElement(robot, "mujoco"), "compiler", strippath="false")
    link = ET.SubElement(robot, "link", name="base")
    for name, file in meshes.items():
        collision = ET.SubElement(link, "collision", name=name)
        geometry = ET.SubElement(collision, "geometry")
        ET.SubElement(geometry, "mesh", filename=file)
    _write(path, robot)


def write_mjcf(path: Path, model: str, meshes: dict[str, str]) -> None:
    """Write a body that moves freely and has the hulls; arguments as `write_urdf`."""
    root = ET.Element("mujoco", model=model)
    assets = ET.SubElement(root, "asset")
    body = ET.SubElement(ET.SubElement(root, "worldbody"), "body", name=model)
    ET.SubElement(body, "freejoint")
    for name, file in meshes.items():
        ET.SubElement(assets, "mesh", name=name, file=file)
        ET.SubElement(body, "geom", name=name, type="mesh", mesh=name)
    _write(path, root)


def _write(path: Path, root: ET.Element) -> None:
    """Write an XML file."""
    ET.indent(root)
    ET.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)
