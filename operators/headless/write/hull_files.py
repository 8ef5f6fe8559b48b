"""Hulls to files: models, or descriptions for simulators with a model a hull."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence
from pathlib import Path

import bpy

from ..quiet import quiet_blender
from ..read.models import axes
from .collider_marks import mark_glb, mark_usd
from .models import replacing, told


def save_hulls(path: Path, hulls: Sequence[bpy.types.Object], up: str) -> None:
    """Write hulls to `path` in the format of its ending.

    Simulators get a file that names each hull's own .obj, in a folder beside it.

    Parameters
    ----------
    path : Path
        File of one of `HULL_ENDINGS`.
    hulls : sequence of Object
    up : {'Y', 'Z'}
        Axis that points up in .obj and .stl.
    """
    bpy.context.view_layer.update()
    with told(path, "written"), replacing(path) as unfinished:
        _EXPORTERS[path.suffix.lower()](unfinished, path, hulls, up)


def folder_of(path: Path) -> Path:
    """Return the folder that the hulls of a simulator's file go to."""
    return path.with_name(f"{path.stem}_hulls")


def _select(hulls: Sequence[bpy.types.Object]) -> None:
    """Select these objects alone; Blender's exporters know selections only."""
    chosen = set(hulls)
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in chosen)


def _glb(file: Path, _: Path, hulls: Sequence[bpy.types.Object], _up: str) -> None:
    _select(hulls)
    with quiet_blender():
        bpy.ops.export_scene.gltf(
            filepath=str(file),
            export_format="GLB",
            use_selection=True,
            export_materials="NONE",
            export_extras=True,
        )
    mark_glb(file)


def _obj(file: Path, _: Path, hulls: Sequence[bpy.types.Object], up: str) -> None:
    _select(hulls)
    with quiet_blender():
        bpy.ops.wm.obj_export(
            filepath=str(file),
            export_selected_objects=True,
            export_materials=False,
            export_normals=False,
            export_uv=False,
            **axes(up),
        )


def _stl(file: Path, _: Path, hulls: Sequence[bpy.types.Object], up: str) -> None:
    _select(hulls)
    # Hulls are not rendered, and since Blender 5.2 only what is rendered is written.
    known = bpy.ops.wm.stl_export.get_rna_type().properties
    mode = (
        {"evaluation_mode": "DAG_EVAL_VIEWPORT"} if "evaluation_mode" in known else {}
    )
    with quiet_blender():
        bpy.ops.wm.stl_export(
            filepath=str(file), export_selected_objects=True, **axes(up), **mode
        )


def _usd(file: Path, _: Path, hulls: Sequence[bpy.types.Object], _up: str) -> None:
    _select(hulls)
    with quiet_blender():
        bpy.ops.wm.usd_export(
            filepath=str(file),
            selected_objects_only=True,
            export_materials=False,
            evaluation_mode="VIEWPORT",  # hulls are not rendered
        )
    mark_usd(file)


def _urdf(file: Path, path: Path, hulls: Sequence[bpy.types.Object], _: str) -> None:
    robot = ET.Element("robot", name=path.stem)
    # MuJoCo looks for meshes beside the file otherwise; others ignore it.
    ET.SubElement(ET.SubElement(robot, "mujoco"), "compiler", strippath="false")
    link = ET.SubElement(robot, "link", name="base")
    for name, mesh in _hull_files(path, hulls):
        collision = ET.SubElement(link, "collision", name=name)
        geometry = ET.SubElement(collision, "geometry")
        ET.SubElement(geometry, "mesh", filename=mesh)
    _write_xml(file, robot)


def _mjcf(file: Path, path: Path, hulls: Sequence[bpy.types.Object], _: str) -> None:
    model = ET.Element("mujoco", model=path.stem)
    assets = ET.SubElement(model, "asset")
    body = ET.SubElement(ET.SubElement(model, "worldbody"), "body", name=path.stem)
    ET.SubElement(body, "freejoint")
    for name, mesh in _hull_files(path, hulls):
        ET.SubElement(assets, "mesh", name=name, file=mesh)
        ET.SubElement(body, "geom", name=name, type="mesh", mesh=name)
    _write_xml(file, model)


def _hull_files(path: Path, hulls: Sequence[bpy.types.Object]) -> list[tuple[str, str]]:
    """Write an .obj for each hull, Z up as simulators have it; return their names.

    The files are named by number: names of objects may hold what files' may not.
    """
    folder = folder_of(path)
    folder.mkdir(exist_ok=True)
    written = []
    for number, hull in enumerate(hulls, start=1):
        mesh = folder / f"{number:03d}.obj"
        _obj(mesh, path, [hull], "Z")
        written.append((hull.name, f"{folder.name}/{mesh.name}"))
    return written


def _write_xml(file: Path, root: ET.Element) -> None:
    ET.indent(root)
    ET.ElementTree(root).write(file, encoding="utf-8", xml_declaration=True)


_EXPORTERS: dict[str, Callable[[Path, Path, Sequence[bpy.types.Object], str], None]] = {
    ".glb": _glb,
    ".obj": _obj,
    ".stl": _stl,
    ".usd": _usd,
    ".urdf": _urdf,
    ".xml": _mjcf,
}
HULL_ENDINGS = tuple(_EXPORTERS)
# Names of formats, where the ending is not that.
HULL_FORMATS = {e.removeprefix("."): e for e in HULL_ENDINGS if e != ".xml"} | {
    "mjcf": ".xml"
}
