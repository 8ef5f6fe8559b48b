"""Refuses coordinates that are infinite, NaN or too large for single precision.

Blender's importers make them 0.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....core.errors import DecompositionError
from ..files.headers import STL_HEADER, n_stl_triangles, read_header

_LARGEST = float(np.finfo(np.float32).max)
# What words have in them that may be no finite numbers: 19 digits and an exponent of 18
# make a small enough one.
_SUSPECT = rb"(?:nan|inf|(?<![\d.])\d{20}|e\+?0*(?:19|[2-9]\d|[1-9]\d\d))"
_ANY_SUSPECT = re.compile(_SUSPECT, re.IGNORECASE)
# Such a word behind the keyword of a line.
_BEHIND = rb"[ \t]([^#\n]*?" + _SUSPECT + rb"[^#\n]*)"
_IN_OBJ = re.compile(rb"^[ \t]*v" + _BEHIND, re.IGNORECASE | re.MULTILINE)
_IN_STL = re.compile(rb"^[ \t]*vertex" + _BEHIND, re.IGNORECASE | re.MULTILINE)
# Vertices in .fbx: in text form, and before their bytes in binary form.
_IN_FBX = re.compile(rb"\bVertices:(?:[^{}:]*\{\s*a:)?([^:}]*)")
_FBX_ARRAY = re.compile(rb"\x08Vertices([df])(.{12})", re.DOTALL)
# The same before version 7: each number is behind a letter.
_FBX_NUMBERS = re.compile(rb"\x08Vertices([DF])")
_STL_TRIANGLE = np.dtype(
    [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]
)


def check_finite(path: Path) -> None:
    """Check that all coordinates of vertices in a file are finite.

    USD files keep such numbers when they are imported, and are not checked here; our
    readers check what they read.

    Parameters
    ----------
    path : Path
        File that Blender has imported, and so finds no other fault with.

    Raises
    ------
    DecompositionError
        If some are not.
    """
    is_finite = _FINDERS.get(path.suffix.lower())
    if is_finite and not is_finite(path):
        raise not_finite(path)


def not_finite(path: Path) -> DecompositionError:
    """Return the error for a file with coordinates that are not finite."""
    return DecompositionError(
        f"{path} has coordinates that are not finite numbers in single precision;"
        " repair it in the program it comes from."
    )


def all_finite(values: NDArray[Any]) -> bool:
    """Return whether all coordinates are finite in single precision."""
    return bool((np.abs(values.astype(np.float64)) <= _LARGEST).all())


def _is_finite(word: bytes) -> bool:
    """Return whether a word is a finite number, or none at all."""
    try:
        return abs(float(word)) <= _LARGEST
    except ValueError:  # such as "-nan(ind)" or "1.#IND"
        start = word.lstrip(b"+-").lower()
        return not (start.startswith((b"nan", b"inf")) or b"#" in word)


def _lines_are_finite(data: bytes, line: re.Pattern[bytes]) -> bool:
    """Return whether all words are finite in the lines that a pattern finds."""
    words = (word for found in line.finditer(data) for word in found[1].split())
    return all(map(_is_finite, words))


def _obj_is_finite(path: Path) -> bool:
    """Return whether all positions are finite."""
    return _lines_are_finite(path.read_bytes().replace(b"\\\n", b" "), _IN_OBJ)


def _stl_is_finite(path: Path) -> bool:
    """Return whether all corners are finite."""
    data = path.read_bytes()
    n_triangles = n_stl_triangles(data, len(data))
    if n_triangles is not None:
        triangles = np.frombuffer(data, _STL_TRIANGLE, n_triangles, STL_HEADER)
        return all_finite(triangles["corners"])
    return _lines_are_finite(data, _IN_STL)


def _ply_is_finite(path: Path) -> bool:
    """Return whether all positions are finite; normals and others are not checked."""
    data = path.read_bytes()
    header = read_header(data)
    if header is None or not header.elements:
        return True  # the importer reports it
    vertex, body = header.elements[0], data[header.size :]
    axes = [name for name in vertex.properties if name in {"x", "y", "z"}]
    if vertex.name != "vertex" or vertex.has_lists or not axes:
        return True  # unusual; the importer decides
    if not header.order:
        return _rows_are_finite(body, vertex.n_rows, list(vertex.properties))
    codes = vertex.properties.items()
    dtype = np.dtype([(name, header.order + code) for name, code in codes])
    table = np.frombuffer(body, dtype, min(vertex.n_rows, len(body) // dtype.itemsize))
    return all(all_finite(table[axis]) for axis in axes)


def _rows_are_finite(body: bytes, n_rows: int, names: list[str]) -> bool:
    """Return whether the x, y and z columns of the first lines are finite."""
    if _ANY_SUSPECT.search(body) is None:
        return True
    columns = [names.index(axis) for axis in "xyz" if axis in names]
    rows = (line.split() for line in body.splitlines()[:n_rows])
    return all(
        _is_finite(row[column])
        for row in rows
        for column in columns
        if column < len(row)
    )


def _fbx_is_finite(path: Path) -> bool:
    """Return whether all vertices are finite; of shape keys, too."""
    data = path.read_bytes()
    if data.startswith(b";"):  # text
        return _lines_are_finite(data.replace(b",", b" "), _IN_FBX)
    return all(map(all_finite, _fbx_arrays(data)))


def _fbx_arrays(data: bytes) -> Iterator[NDArray[Any]]:
    """Yield the vertices of each mesh in a binary file."""
    for found in _FBX_ARRAY.finditer(data):
        length, is_packed, size = np.frombuffer(found[2], "<u4").tolist()
        content = data[found.end() : found.end() + size]
        if is_packed:
            content = zlib.decompress(content)
        yield np.frombuffer(content, f"<{found[1].decode()}", length)
    for found in _FBX_NUMBERS.finditer(data):
        row = np.dtype([("letter", "S1"), ("number", f"<{found[1].decode().lower()}")])
        (length,) = np.frombuffer(data, "<u4", 1, found.start() - 8)
        yield np.frombuffer(data, row, length, found.start(1))["number"]


def _gltf_is_finite(path: Path) -> bool:
    """Return whether all positions are finite, as the add-on that imports them reads.

    Meshes that no node has are not imported.
    """
    from io_scene_gltf2.io.imp.gltf2_io_binary import BinaryData  # Blender's add-on
    from io_scene_gltf2.io.imp.gltf2_io_gltf import glTFImporter

    read = glTFImporter(str(path), {"import_user_extensions": []})
    read.read()
    meshes = {node.mesh for node in read.data.nodes or ()} - {None}
    if not meshes <= {*range(len(read.data.meshes or ()))}:
        raise DecompositionError(
            f"{path} has a node whose mesh is missing; export it again."
        )
    attributes = [
        each.attributes for mesh in meshes for each in read.data.meshes[mesh].primitives
    ]
    accessors = {each["POSITION"] for each in attributes if "POSITION" in each}
    return all(all_finite(BinaryData.decode_accessor(read, k)) for k in accessors)


_FINDERS: dict[str, Callable[[Path], bool]] = {
    ".obj": _obj_is_finite,
    ".stl": _stl_is_finite,
    ".ply": _ply_is_finite,
    ".fbx": _fbx_is_finite,
    ".glb": _gltf_is_finite,
    ".gltf": _gltf_is_finite,
}
