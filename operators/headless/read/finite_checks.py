"""Refuses coordinates that are infinite or NaN; Blender's importers make them 0."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ....core.errors import DecompositionError
from .damage_checks import n_stl_triangles
from .ply_files import read_header

# NaN or infinity behind the keyword of a line.
_WORD = rb"[ \t].*?(?<![\w.])(nan|inf|infinity)\b"
_IN_OBJ = re.compile(rb"^[ \t]*v" + _WORD, re.IGNORECASE | re.MULTILINE)
_IN_STL = re.compile(rb"^[ \t]*vertex" + _WORD, re.IGNORECASE | re.MULTILINE)
_STL_TRIANGLE = np.dtype(
    [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]
)


def check_finite(path: Path) -> None:
    """Check that all coordinates in an .obj, .stl or .ply file are finite.

    Raises
    ------
    DecompositionError
        If some are not.
    """
    finders = {".obj": _obj_is_finite, ".stl": _stl_is_finite, ".ply": _ply_is_finite}
    is_finite = finders.get(path.suffix.lower())
    if is_finite and not is_finite(path.read_bytes()):
        raise not_finite(path)


def not_finite(path: Path) -> DecompositionError:
    """Return the error for a file with coordinates that are not finite."""
    return DecompositionError(
        f"{path.name} has coordinates that are not finite numbers; repair it in the"
        " program it comes from."
    )


def _obj_is_finite(data: bytes) -> bool:
    """Return whether all positions are finite."""
    return _IN_OBJ.search(data) is None


def _stl_is_finite(data: bytes) -> bool:
    """Return whether all corners are finite."""
    n_triangles = n_stl_triangles(data[:84], len(data))
    if n_triangles is not None:
        triangles = np.frombuffer(data, _STL_TRIANGLE, n_triangles, offset=84)
        return bool(np.isfinite(triangles["corners"]).all())
    return _IN_STL.search(data) is None


def _ply_is_finite(data: bytes) -> bool:
    """Return whether all positions are finite; normals and others are not checked."""
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
    return all(np.isfinite(table[axis]).all() for axis in axes)


def _rows_are_finite(body: bytes, n_rows: int, names: list[str]) -> bool:
    """Return whether the x, y and z columns of the first lines are finite."""
    lower = body.lower()
    if b"nan" not in lower and b"inf" not in lower:
        return True
    columns = [names.index(axis) for axis in "xyz" if axis in names]
    rows = (line.split() for line in lower.splitlines()[:n_rows])
    return not any(
        row[column].lstrip(b"+-").startswith((b"nan", b"inf"))
        for row in rows
        for column in columns
        if column < len(row)
    )
