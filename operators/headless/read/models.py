"""Loads a file of any supported kind into a clean scene."""

from __future__ import annotations

import re
from collections.abc import Callable
from math import pi
from pathlib import Path

import addon_utils
import bpy

from ....core.errors import DecompositionError
from ...bridge.hulls.hull_objects import is_hull
from ...bridge.mesh.points import is_cloud, set_points
from ..quiet import quiet_blender
from .file_checks import check_file
from .finite_checks import check_finite
from .off import read_off
from .points import read_points

# Formats whose files do not say which axis points up, with the axis that it is
# most often.
USUAL_UP = {".obj": "Y", ".off": "Y", ".ply": "Z", ".stl": "Z"}


def axes(up: str) -> dict[str, str]:
    """Return the options of Blender's importers and exporters for an up axis."""
    forward = {"Y": "NEGATIVE_Z", "Z": "Y"}[up]
    return {"forward_axis": forward, "up_axis": up}


def load(path: Path, up: str | None = None) -> list[bpy.types.Object]:
    """Load `path` into a clean scene and return its mesh objects, by name.

    Parameters
    ----------
    path : Path
        File of one of `ENDINGS`.
    up : {'Y', 'Z'}, optional
        Axis of the file that points up, for formats that do not say so.

    Raises
    ------
    DecompositionError
        If the file cannot be read, or holds no mesh.
    """
    check_file(path, ENDINGS)
    check_finite(path)
    ending = path.suffix.lower()
    _clean_scene()
    try:
        with quiet_blender():
            result = _IMPORTERS[ending](path, up or USUAL_UP.get(ending, "Z"))
    except RuntimeError as error:  # what bpy.ops makes of every failure
        raise DecompositionError(_sentence(path, str(error))) from error
    if result != {"FINISHED"}:
        raise DecompositionError(_sentence(path, "the importer gave up"))
    objects = mesh_objects()
    if not objects:
        raise DecompositionError(f"{path.name} has no meshes or point clouds.")
    if not any(is_cloud(obj) or obj.data.polygons for obj in objects):
        raise DecompositionError(
            f"{path.name} has edges but no faces; wires cannot be decomposed."
        )
    return objects


def _clean_scene() -> None:
    """Empty Blender, without touching the user's settings and extensions."""
    with quiet_blender():
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)


def mesh_objects() -> list[bpy.types.Object]:
    """Return the meshes and point clouds that some view layer of the file shows.

    Hulls that an earlier run built are none of them: building anew replaces them.
    """
    found = {
        obj
        for scene in bpy.data.scenes
        for layer in scene.view_layers
        for obj in layer.objects
        if obj.type in {"MESH", "POINTCLOUD"} and not is_hull(obj)
    }
    return sorted(found, key=lambda obj: obj.name_full)


def _sentence(path: Path, message: str) -> str:
    """Return the last line of an importer's message, within a sentence."""
    lines = [line.strip() for line in message.splitlines() if line.strip()]
    # A Python importer's traceback ends with where bpy.ops was called.
    lines = [line for line in lines if not line.startswith("Location:")]
    reason = lines[-1].removeprefix("Error: ").rstrip(".") if lines else "no reason"
    if path.name in reason:  # after which comes the reason proper
        reason = reason.rpartition(": ")[2].strip("'")
        reason = re.sub(rf"\S*{re.escape(path.name)}", f'"{path.name}', reason)
    return (
        f"{path.name} cannot be read as {path.suffix.lower()}: it is incomplete,"
        f" damaged or of another kind ({reason})."
    )


def _enable(addon: str) -> None:
    """Enable an add-on that comes with Blender, for this session only."""
    if not addon_utils.check(addon)[1] and addon_utils.enable(addon) is None:
        raise RuntimeError(f"Blender's add-on {addon} is missing")


def _obj(path: Path, up: str) -> set[str]:
    return set(bpy.ops.wm.obj_import(filepath=str(path), **axes(up)))


def _ply(path: Path, up: str) -> set[str]:
    return set(bpy.ops.wm.ply_import(filepath=str(path), **axes(up)))


def _stl(path: Path, up: str) -> set[str]:
    return set(bpy.ops.wm.stl_import(filepath=str(path), **axes(up)))


def _off(path: Path, up: str) -> set[str]:
    vertices, polygons = read_off(path)
    mesh = bpy.data.meshes.new(path.stem)
    mesh.from_pydata(vertices, [], [row for row in polygons if len(row) > 2])
    mesh.validate()
    _placed(mesh, up)
    return {"FINISHED"}


def _points(path: Path, up: str) -> set[str]:
    points, normals = read_points(path)
    mesh = bpy.data.meshes.new(path.stem)
    mesh.from_pydata(points, [], [])
    obj = _placed(mesh, up)
    if normals is not None:
        set_points(obj, "normal", "FLOAT_VECTOR", normals)
    return {"FINISHED"}


def _placed(mesh: bpy.types.Mesh, up: str) -> bpy.types.Object:
    """Return a new object of the scene with a mesh, turned upright."""
    obj = bpy.data.objects.new(mesh.name, mesh)
    obj.rotation_euler.x = pi / 2 if up == "Y" else 0.0
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.update()
    return obj


def _gltf(path: Path, _up: str) -> set[str]:
    _enable("io_scene_gltf2")
    # glTF splits vertices at sharp edges; merged, faces know their neighbors again.
    return set(bpy.ops.import_scene.gltf(filepath=str(path), merge_vertices=True))


def _fbx(path: Path, _up: str) -> set[str]:
    if "fbx_import" in dir(bpy.ops.wm):  # newer Blenders; reads text FBX as well
        return set(bpy.ops.wm.fbx_import(filepath=str(path)))
    _enable("io_scene_fbx")
    return set(bpy.ops.import_scene.fbx(filepath=str(path)))


def _blend(path: Path, _up: str) -> set[str]:
    return set(
        bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False, use_scripts=False)
    )


_IMPORTERS: dict[str, Callable[[Path, str], set[str]]] = {
    ".obj": _obj,
    ".ply": _ply,
    ".stl": _stl,
    ".off": _off,
    ".xyz": _points,
    ".pwn": _points,
    ".pts": _points,
    ".glb": _gltf,
    ".gltf": _gltf,
    ".fbx": _fbx,
    ".blend": _blend,
}
ENDINGS = tuple(_IMPORTERS)
