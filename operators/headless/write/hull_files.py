"""Writes collision hulls: .glb .obj .stl .usd, and .urdf .xml for simulators."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import bpy

from ..atomic import explaining, replacing
from ..files.output_folders import replacing_with_folder
from ..files.whole import check_obj
from ..formats import axes
from ..quiet import quiet_blender
from .collider_marks import mark_glb, mark_usd
from .simulator_files import write_mjcf, write_urdf


def save_hulls(path: Path, hulls: Sequence[bpy.types.Object], up: str) -> None:
    """Write hulls to `path` in the format of its ending.

    For simulators each hull becomes an .obj file in a folder beside `path`, and
    `path` refers to them. The folder is that of `replacing_with_folder`.

    Parameters
    ----------
    path : Path
        File with one of `HULL_ENDINGS`.
    hulls : sequence of Object
    up : {'Y', 'Z'}
        Axis that points up in .obj and .stl.

    Raises
    ------
    DecompositionError
        If the files cannot be written.
    """
    ending = path.suffix.lower()
    bpy.context.view_layer.update()
    with explaining(path, "written"):
        if ending in _SIMULATORS:
            with replacing_with_folder(path) as (unfinished, folder):
                meshes = _save_each(hulls, folder)
                _SIMULATORS[ending](unfinished, path.stem, meshes)
        else:
            with replacing(path) as unfinished:
                _export(_EXPORTERS[ending], unfinished, hulls, up)


def _save_each(hulls: Sequence[bpy.types.Object], folder: Path) -> dict[str, str]:
    """Write each hull to an .obj file of its own; return the files by hull.

    Z is up, as in simulators. The files are numbered: the name of an object may
    contain characters that the name of a file may not.
    """
    files = {}
    for number, hull in enumerate(hulls, start=1):
        file = folder / f"{number:03d}.obj"
        _export(_obj, file, [hull], "Z")
        files[hull.name] = f"{folder.name}/{file.name}"
    return files


def _export(
    exporter: Callable[[Path, str], None],
    path: Path,
    hulls: Sequence[bpy.types.Object],
    up: str,
) -> None:
    """Write hulls by one of Blender's exporters; they write what is selected."""
    chosen = set(hulls)
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in chosen)
    with quiet_blender():
        exporter(path, up)


def _glb(path: Path, _up: str) -> None:
    """Export .glb with colliders."""
    bpy.ops.export_scene.gltf(
        filepath=str(path),
        export_format="GLB",
        use_selection=True,
        export_materials="NONE",
        export_extras=True,
    )
    mark_glb(path)


def _obj(path: Path, up: str) -> None:
    """Export .obj."""
    bpy.ops.wm.obj_export(
        filepath=str(path),
        export_selected_objects=True,
        export_materials=False,
        export_normals=False,
        export_uv=False,
        **axes(up),
    )
    hulls = bpy.context.selected_objects
    check_obj(path, sum(len(hull.data.polygons) for hull in hulls))


def _stl(path: Path, up: str) -> None:
    """Export .stl."""
    # Hulls are hidden in renders, and Blender 5.2 and later write what is rendered.
    known = bpy.ops.wm.stl_export.get_rna_type().properties
    mode = (
        {"evaluation_mode": "DAG_EVAL_VIEWPORT"} if "evaluation_mode" in known else {}
    )
    bpy.ops.wm.stl_export(
        filepath=str(path), export_selected_objects=True, **axes(up), **mode
    )


def _usd(path: Path, _up: str) -> None:
    """Export .usd with colliders."""
    bpy.ops.wm.usd_export(
        filepath=str(path),
        selected_objects_only=True,
        export_materials=False,
        evaluation_mode="VIEWPORT",  # hulls are hidden in renders
    )
    mark_usd(path)


_EXPORTERS: dict[str, Callable[[Path, str], None]] = {
    ".glb": _glb,
    ".obj": _obj,
    ".stl": _stl,
    ".usd": _usd,
}
_SIMULATORS: dict[str, Callable[[Path, str, dict[str, str]], None]] = {
    ".urdf": write_urdf,
    ".xml": write_mjcf,
}
