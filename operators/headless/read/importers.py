"""One importer for each ending: Blender's, or our readers of .off and point files.

Each takes a path and the axis that points up, adds objects to the scene and returns
{'FINISHED'}, as Blender's operators do. Formats that state their axis ignore `up`.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from pathlib import Path

import bpy

from ....core.errors import DecompositionError
from ...bridge.mesh.attributes import read_ints, write_attribute
from ...bridge.stored.names import COLOR_LAYER
from ..formats import FBX, GLTF, axes, enable
from .numbering import number_in_order
from .off_files import read_off
from .xyz_files import read_points


def _mesh(path: Path, up: str) -> set[str]:
    """Import .obj, .ply or .stl."""
    operator = getattr(bpy.ops.wm, f"{path.suffix[1:].lower()}_import")
    return set(operator(filepath=str(path), **axes(up)))


def _off(path: Path, up: str) -> set[str]:
    """Import .off by our reader."""
    vertices, polygons = read_off(path)
    mesh = bpy.data.meshes.new(path.stem)
    mesh.from_pydata(vertices, [], [row for row in polygons if len(row) > 2])
    mesh.validate()
    _add_object(mesh, up)
    return {"FINISHED"}


def _points(path: Path, up: str) -> set[str]:
    """Import .xyz, .pwn or .pts by our reader."""
    points, normals = read_points(path)
    mesh = bpy.data.meshes.new(path.stem)
    mesh.from_pydata(points, [], [])
    obj = _add_object(mesh, up)
    if normals is not None:
        write_attribute(obj.data, "normal", "FLOAT_VECTOR", "POINT", normals)
    return {"FINISHED"}


def _gltf(path: Path, _up: str) -> set[str]:
    """Import .glb or .gltf."""
    enable(GLTF)
    result = set(
        bpy.ops.import_scene.gltf(
            filepath=str(path),
            # glTF splits vertices at sharp edges; merging them joins the faces again.
            merge_vertices=True,
            disable_bone_shape=True,  # a mesh that is not of the file
        )
    )
    # Newer Blenders exclude what is in other scenes than the first, or in none.
    for child in bpy.context.view_layer.layer_collection.children:
        child.exclude = False
    bpy.context.scene.frame_set(0)  # time 0; Blender shows the next frame
    return result


def _fbx(path: Path, _up: str) -> set[str]:
    """Import .fbx."""
    if "fbx_import" in dir(bpy.ops.wm):  # newer Blenders; it reads text FBX, too
        result = set(bpy.ops.wm.fbx_import(filepath=str(path)))
        _count_users()
    elif _is_text(path):
        raise DecompositionError(
            f"{path} is .fbx in text form, which Blender 4.5 and later reads; save"
            " it in binary form, or use a newer Blender."
        )
    else:
        enable(FBX)
        result = set(bpy.ops.import_scene.fbx(filepath=str(path)))
    _forget_colors()
    return result


def _is_text(path: Path) -> bool:
    """Return whether an .fbx file is in text form."""
    with path.open("rb") as file:
        return file.read(1) == b";"


def _forget_colors() -> None:
    """Remove colors of parts, which .fbx files of ours may have without the parts."""
    for mesh in bpy.data.meshes:
        colors = mesh.attributes.get(COLOR_LAYER)
        if colors:
            mesh.attributes.remove(colors)


def _count_users() -> None:
    """Count the objects that share a mesh; Blender's importer of .fbx counts one.

    Blender would remove a mesh, and with it all of these objects, once one of them
    gets another. Assigning data counts, and a count does not fall below 0.
    """
    sharing: dict[bpy.types.Mesh, list[bpy.types.Object]] = {}
    for obj in bpy.data.objects:
        if obj.type == "MESH":
            sharing.setdefault(obj.data, []).append(obj)
    for mesh, objects in sharing.items():
        if mesh.users < len(objects):
            stand_in = mesh.copy()
            for data in (stand_in, mesh):
                for obj in objects:
                    obj.data = data
            bpy.data.meshes.remove(stand_in)


def _usd(path: Path, _up: str) -> set[str]:
    """Import .usd, .usda, .usdc or .usdz.

    Blender numbers objects of one name in any order, and keeps the prototypes of
    instances in a hidden collection. Older ones keep faces of one or two corners, and
    crash on them.
    """
    result = set(bpy.ops.wm.usd_import(filepath=str(path)))
    for mesh in bpy.data.meshes:
        if read_ints(mesh.polygons, "loop_total").min(initial=3) < 3:
            mesh.validate()
    bpy.context.view_layer.update()
    for child in bpy.context.view_layer.layer_collection.children:
        child.exclude = child.collection.hide_viewport
    number_in_order(bpy.data.objects)
    scene = bpy.context.scene
    scene.frame_set(scene.frame_start)  # that of the stage
    return result


def _blend(path: Path, _up: str) -> set[str]:
    """Open .blend in place of the empty file, in Object Mode; its scripts do not run.

    In other modes, meshes have no faces for exporters, or operators refuse to work.
    """
    result = set(
        bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False, use_scripts=False)
    )
    objects = bpy.context.view_layer.objects
    active = objects.active
    for obj in [each for each in objects if each.mode != "OBJECT"]:
        objects.active = obj
        bpy.ops.object.mode_set(mode="OBJECT")
    objects.active = active
    return result


def _add_object(mesh: bpy.types.Mesh, up: str) -> bpy.types.Object:
    """Add an object with a mesh to the scene, rotated so that `up` points up."""
    obj = bpy.data.objects.new(mesh.name, mesh)
    obj.rotation_euler.x = pi / 2 if up == "Y" else 0.0
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.update()
    return obj


IMPORTERS: dict[str, Callable[[Path, str], set[str]]] = {
    ".obj": _mesh,
    ".ply": _mesh,
    ".stl": _mesh,
    ".off": _off,
    ".xyz": _points,
    ".pwn": _points,
    ".pts": _points,
    ".glb": _gltf,
    ".gltf": _gltf,
    ".fbx": _fbx,
    ".usd": _usd,
    ".usda": _usd,
    ".usdc": _usd,
    ".usdz": _usd,
    ".blend": _blend,
}
