"""Writes MJCF, the format of MuJoCo: bodies that move freely."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ....bridge.hulls.placed import Primitive, quaternion_of
from ..placed_meshes import DOUBLE, digits_of
from .bodies import Body, Geometry
from .small_hulls import is_shell
from .urdf import write_xml

# The groups that MuJoCo's viewer shows and hides: 2 is shown at first, 3 is not.
_VISUAL = {"group": "2", "contype": "0", "conaffinity": "0"}
_COLLISION = {"group": "3"}


def write_mjcf(path: Path, bodies: Sequence[Body], folder: str) -> None:
    """Write bodies with their masses, hulls and visible meshes.

    Parameters
    ----------
    path : Path
        The file to write. The model is called like it, without the ending.
    bodies : sequence of Body
    folder : str
        The folder of the meshes, relative to `path`.
    """
    root = ET.Element("mujoco", model=path.stem)
    defaults = ET.SubElement(root, "default")
    for name, settings in (("visual", _VISUAL), ("collision", _COLLISION)):
        ET.SubElement(
            ET.SubElement(defaults, "default", {"class": name}), "geom", settings
        )
    assets, world = ET.SubElement(root, "asset"), ET.SubElement(root, "worldbody")
    for body in bodies:
        element = ET.SubElement(
            world,
            "body",
            name=body.name,
            pos=digits_of(body.frame[:3, 3]),
            quat=digits_of(quaternion_of(body.frame[:3, :3])),
        )
        ET.SubElement(element, "freejoint", name=body.name)
        _add_inertia(element, body)
        for shape in body.visuals:
            # Open meshes have no volume, which MuJoCo refuses without "shell".
            _add_mesh(assets, shape, folder, inertia="shell")
            _add_geom(element, shape, "visual", rgba=digits_of(np.array(shape.color)))
        for shape in body.collisions:
            if shape.primitive is None:
                small = {"inertia": "shell"} if is_shell(shape) else {}
                _add_mesh(assets, shape, folder, **small)
            _add_geom(element, shape, "collision")
    write_xml(path, root)


def _add_inertia(element: ET.Element, body: Body) -> None:
    """Add the mass of a body."""
    rows = body.mass.inertia
    upper = rows[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    ET.SubElement(
        element,
        "inertial",
        pos=digits_of(body.mass.center),
        mass=f"{body.mass.mass:.9g}",
        # Nine digits would lose the thin direction of a plate.
        fullinertia=digits_of(upper, DOUBLE),
    )


def _add_mesh(assets: ET.Element, shape: Geometry, folder: str, **more: str) -> None:
    """Add the mesh of a shape."""
    settings = {"name": shape.name, "file": f"{folder}/{shape.file}", **more}
    ET.SubElement(assets, "mesh", settings)


def _add_geom(element: ET.Element, shape: Geometry, kind: str, **more: str) -> None:
    """Add a shape to a body."""
    settings = {"name": shape.name, "class": kind, **more}
    if shape.primitive is None:
        settings |= {"type": "mesh", "mesh": shape.name}
    else:
        settings |= _settings_of(shape.primitive)
    ET.SubElement(element, "geom", settings)


def _settings_of(primitive: Primitive) -> dict[str, str]:
    """Return the attributes of a primitive."""
    lengths = {"BOX": [0, 1, 2], "SPHERE": [0]}.get(primitive.kind, [0, 2])
    return {
        "type": primitive.kind.lower(),
        "size": digits_of(primitive.sizes[lengths]),
        "pos": digits_of(primitive.center),
        "quat": digits_of(quaternion_of(primitive.rotation)),
    }
