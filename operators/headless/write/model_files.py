"""Writes the model with its parts: .blend .glb .ply .obj."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import bpy

from ..atomic import explaining, replacing
from ..formats import USUAL_UP, axes
from ..quiet import quiet_blender
from .ply_copies import ply_copies


def save(path: Path, up: str | None) -> None:
    """Write the scene to `path` in the format of its ending.

    An existing file is replaced once the new one is complete.

    Parameters
    ----------
    path : Path
        File with one of `MODEL_ENDINGS`.
    up : {'Y', 'Z'} or None
        Axis that points up in .obj and .ply; None for the usual one of the format.

    Raises
    ------
    DecompositionError
        If the file cannot be written.
    """
    ending = path.suffix.lower()
    with explaining(path, "written"), replacing(path) as unfinished:
        with quiet_blender():
            _EXPORTERS[ending](unfinished, up or USUAL_UP.get(ending, "Z"))
        if ending == ".obj":
            _move_materials(unfinished, path)


def _move_materials(unfinished: Path, path: Path) -> None:
    """Give the .mtl file of an .obj file its final name, also inside the .obj file."""
    materials = unfinished.with_suffix(".mtl")
    final = path.with_suffix(".mtl")
    text = unfinished.read_bytes()
    old, new = (f"mtllib {p.name}".encode() for p in (materials, final))
    unfinished.write_bytes(text.replace(old, new, 1))
    with replacing(final) as target:  # perhaps on another disk, by a link
        shutil.move(materials, target)


def _blend(path: Path, _up: str) -> None:
    """Save a copy as .blend."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)


def _glb(path: Path, _up: str) -> None:
    """Export .glb."""
    # The extras hold the record, which is the custom property "wcd" of each object.
    bpy.ops.export_scene.gltf(
        filepath=str(path), export_format="GLB", export_extras=True
    )


def _obj(path: Path, up: str) -> None:
    """Export .obj."""
    # Parts belong to the faces without modifiers.
    bpy.ops.wm.obj_export(
        filepath=str(path),
        apply_modifiers=False,
        export_material_groups=True,
        **axes(up),
    )


def _ply(path: Path, up: str) -> None:
    """Export .ply with colors on the vertices."""
    with ply_copies():
        bpy.ops.wm.ply_export(
            filepath=str(path),
            apply_modifiers=False,
            export_selected_objects=True,
            export_colors="SRGB",
            **axes(up),
        )


_EXPORTERS: dict[str, Callable[[Path, str], None]] = {
    ".blend": _blend,
    ".glb": _glb,
    ".ply": _ply,
    ".obj": _obj,
}
