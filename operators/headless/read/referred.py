"""What a file refers to: libraries, materials, textures and buffers beside it."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import unquote

import bpy

from ....core.errors import DecompositionError
from ..quiet import quiet_blender

_OBJ_MATERIALS = re.compile(rb"^[ \t]*mtllib[ \t]+(.+?)[ \t\r]*$", re.MULTILINE)


def referred_files(path: Path) -> tuple[Path, ...]:
    """Return the files that an input refers to; some may be missing.

    Parameters
    ----------
    path : Path
        The input, which is open in Blender, or imported into an empty file. Links to
        libraries are still links.

    Raises
    ------
    DecompositionError
        If a layer of USD is damaged.
    """
    found = {Path(each) for each in bpy.utils.blend_paths(absolute=True)}
    named = _NAMED_IN.get(path.suffix.lower())
    if named:
        found |= {path.parent / name for name in named(path)}
    return tuple(sorted(found))


def _of_obj(path: Path) -> Iterator[str]:
    """Yield the files of materials; Blender looks for one of the model's name, too."""
    yield path.with_suffix(".mtl").name
    for name in _OBJ_MATERIALS.findall(path.read_bytes()):
        yield os.fsdecode(name.strip(b'"')).replace("\\", "/")


def _of_gltf(path: Path) -> Iterator[str]:
    """Yield the buffers and images; those of a .glb file are mostly in it."""
    scene = json.loads(path.read_bytes())
    for each in (*scene.get("buffers", ()), *scene.get("images", ())):
        address = each.get("uri") or "data:"
        if not address.startswith("data:"):
            yield unquote(address)


def _of_usd(path: Path) -> Iterator[str]:
    """Yield the layers and textures, and those of the layers."""
    try:
        from pxr import Tf, UsdUtils
    except ImportError:  # not in every Blender
        return
    try:
        with quiet_blender():  # what is missing is told by us
            layers, files, missing = UsdUtils.ComputeAllDependencies(str(path))
    except Tf.ErrorException as error:
        raise DecompositionError(
            f"{path} refers to a layer of USD that is damaged; export that again."
        ) from error
    yield from (layer.realPath for layer in layers[1:])  # the first one is the file
    yield from (*files, *missing)


_NAMED_IN: dict[str, Callable[[Path], Iterator[str]]] = {
    ".obj": _of_obj,
    ".gltf": _of_gltf,
    ".usd": _of_usd,
    ".usda": _of_usd,
    ".usdc": _of_usd,
    ".usdz": _of_usd,
}
