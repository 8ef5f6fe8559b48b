"""Reads .off files; Blender has no importer for them."""

from __future__ import annotations

import re
from itertools import islice
from pathlib import Path

import numpy as np

from ....core.errors import DecompositionError
from ....core.steps.arrays import FloatArray
from ..files.text import lines_of, whole_number
from .damage_checks import wordy
from .finite_checks import all_finite, not_finite

# STOFF, COFF and NOFF add columns after the coordinates. Some writers put no space
# after the keyword: "OFF490 518 0".
_HEADER = re.compile(r"(ST)?C?N?OFF(?![A-Za-z])\s*(.*)")


def read_off(path: Path) -> tuple[FloatArray, list[list[int]]]:
    """Return the vertices (V, 3) and the polygons of an .off file.

    Colors, normals and texture coordinates are ignored.

    Raises
    ------
    DecompositionError
        If the file is not OFF, is cut short or has a face without its vertices.
    """
    n_vertices, n_faces, body = _header([*lines_of(path)], path)
    if len(body) < n_vertices + n_faces:
        raise DecompositionError(
            f"{path} is truncated: it promises {n_vertices} vertices and"
            f" {n_faces} faces, one a line, but has {len(body)} lines of them."
        )
    rows = body[: n_vertices + n_faces]
    if any("_" in row for row in rows):  # Python reads 1_0 as 10
        raise wordy(path)
    vertices = _vertices(rows[:n_vertices], path)
    if not all_finite(vertices):
        raise not_finite(path)
    return vertices, [_polygon(row, n_vertices, path) for row in rows[n_vertices:]]


def n_faces_of_off(path: Path) -> int:
    """Return how many faces an .off file has, also those with too few corners."""
    return _header([*islice(lines_of(path), 2)], path)[1]


def _header(lines: list[str], path: Path) -> tuple[int, int, list[str]]:
    """Return the numbers of vertices and faces, and the lines after them."""
    match = _HEADER.fullmatch(lines[0]) if lines else None
    if match is None:
        raise DecompositionError(
            f"{path} does not begin like an OFF file in text form; export it again"
            " as plain OFF."
        )
    rest = match.group(2)
    counts, body = (rest, lines[1:]) if rest else ("".join(lines[1:2]), lines[2:])
    numbers = [whole_number(word) for word in counts.split()[:2]]
    n_vertices, n_faces = numbers if len(numbers) == 2 else (None, None)
    if n_vertices is None or n_faces is None:
        raise DecompositionError(
            f"{path} does not state its numbers of vertices and faces; it is"
            " truncated or a binary or other kind of OFF."
        )
    return n_vertices, n_faces, body


def _vertices(rows: list[str], path: Path) -> FloatArray:
    """Return the first three numbers of each row, (V, 3)."""
    try:
        values = [[float(word) for word in row.split(None, 3)[:3]] for row in rows]
        return np.array(values, dtype=np.float64).reshape(len(rows), 3)
    except ValueError as error:
        raise DecompositionError(
            f"{path} has a vertex that is not three numbers; it is damaged."
        ) from error


def _polygon(row: str, n_vertices: int, path: Path) -> list[int]:
    """Return the corners of the face in `row`."""
    try:
        words = row.split()
        corners = [int(word) for word in words[1 : 1 + int(words[0])]]
        complete = len(corners) == int(words[0])
    except ValueError:
        complete = False
        corners = []
    if not complete:
        raise DecompositionError(
            f"{path} has a face whose corners are not whole numbers, or too few; it"
            " is truncated or damaged."
        )
    if corners and not 0 <= min(corners) <= max(corners) < n_vertices:
        raise DecompositionError(
            f"{path} has a face that refers to a vertex it does not have; it is"
            " damaged."
        )
    return corners
