"""What a file refers to: libraries, materials, textures and buffers beside it."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import unquote

import bpy

_OBJ_MATERIALS = re.compile(rb"^[ \t]*mtllib[ \t]+(.+?)[ \t\r]*$", re.MULTILINE)
# Layers and textures in the text form of USD.
_USD_ASSET = re.compile(rb"@+([^@\n]+)@+")
_USD_TEXT = b"#usda"


def referred_files(path: Path) -> tuple[Path, ...]:
    """Return the files that an input refers to; some may be missing.

    Parameters
    ----------
    path : Path
        The input, which is open in Blender, or imported into an empty file. Links to
        libraries are still links.
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
    """Yield the layers and textures, if the file is text."""
    data = path.read_bytes()
    if data.startswith(_USD_TEXT):
        yield from map(os.fsdecode, _USD_ASSET.findall(data))


_NAMED_IN: dict[str, Callable[[Path], Iterator[str]]] = {
    ".obj": _of_obj,
    ".gltf": _of_gltf,
    ".usd": _of_usd,
    ".usda": _of_usd,
}
