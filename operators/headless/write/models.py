"""Writes the scene to a file of any supported kind, whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import bpy

from ....core.errors import DecompositionError
from ..quiet import quiet_blender
from ..read.models import axes
from .seam_split import split_at_seams

# What each format is used to, for inputs that say themselves which axis is up.
_USUAL_UP = {".obj": "Y", ".ply": "Z"}


def save(path: Path, up: str | None) -> None:
    """Write the scene to `path` in the format of its ending.

    An existing file is replaced once the new one is complete.

    Parameters
    ----------
    path : Path
        File of one of `ENDINGS`.
    up : {'Y', 'Z'} or None
        Axis that points up in formats that do not say so, None for the usual one.
    """
    ending = path.suffix.lower()
    with told(path, "written"), replacing(path) as unfinished:
        with quiet_blender():
            _EXPORTERS[ending](unfinished, up or _USUAL_UP.get(ending, "Z"))
        if ending == ".obj":
            _move_materials(unfinished, path)


@contextmanager
def told(path: Path, done: str) -> Iterator[None]:
    """Raise what goes wrong as a sentence: that `path` cannot be `done`, and why."""
    try:
        yield
    except (RuntimeError, OSError) as error:
        reason = str(error).strip().splitlines()[-1].removeprefix("Error: ")
        raise DecompositionError(f"{path} cannot be {done} ({reason}).") from error


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a file beside `path` to write to, which becomes `path` if all goes well."""
    handle, name = tempfile.mkstemp(prefix=".wcd-", suffix=path.suffix, dir=path.parent)
    os.close(handle)
    unfinished = Path(name)
    unfinished.unlink()  # so that exporters need not overwrite
    try:
        yield unfinished
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


def _move_materials(unfinished: Path, path: Path) -> None:
    """Give the .mtl file of an .obj its final name, in the .obj as well."""
    materials = unfinished.with_suffix(".mtl")
    final = path.with_suffix(".mtl")
    text = unfinished.read_bytes()
    old, new = (f"mtllib {p.name}".encode() for p in (materials, final))
    unfinished.write_bytes(text.replace(old, new, 1))
    materials.replace(final)


def _blend(path: Path, _up: str) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)


def _glb(path: Path, _up: str) -> None:
    # Extras carry the record, the objects' custom property "wcd".
    bpy.ops.export_scene.gltf(
        filepath=str(path), export_format="GLB", export_extras=True
    )


def _obj(path: Path, up: str) -> None:
    # Modifiers stay out, as they were when the faces got their parts.
    bpy.ops.wm.obj_export(
        filepath=str(path),
        apply_modifiers=False,
        export_material_groups=True,
        **axes(up),
    )


def _ply(path: Path, up: str) -> None:
    with split_at_seams():
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
ENDINGS = tuple(_EXPORTERS)
