"""Reads .xyz, .pwn and .pts files; Blender has no importers for them.

Each line is a point, x y z, x y z nx ny nz or x y z r g b. The first line may state the
number of points. .pwn files may list all points first and all normals after them.
"""

from __future__ import annotations

import re
from io import StringIO
from pathlib import Path

import numpy as np

from ....core.errors import DecompositionError
from ....core.steps.arrays import FloatArray
from ..files.text import lines_of, whole_number
from .finite_checks import all_finite, not_finite

# A line that begins with two numbers with commas in place of decimal points.
_COMMA = r"[-+]?\d+,\d+(?:[eE][-+]?\d+)?"
_DECIMAL_COMMAS = re.compile(rf"^\s*{_COMMA}[ \t;]+{_COMMA}(?!\S)", re.MULTILINE)

# Normals differ from length 1 by less, in most of their rows.
_NOT_UNIT = 0.01

Points = tuple[FloatArray, FloatArray | None]


def read_points(path: Path) -> Points:
    """Return the points (N, 3) of a file, and their normals (N, 3) or None.

    Three more columns are normals, unless they look like colors. Colors and any other
    number of columns are ignored.

    Raises
    ------
    DecompositionError
        If the rows are not numbers or differ in length, or the file is cut short.
    """
    text = "\n".join(lines_of(path))
    if _DECIMAL_COMMAS.search(text):
        raise DecompositionError(
            f"{path} has commas in its numbers; write decimal points instead."
        )
    if not text:
        raise DecompositionError(f"{path} has no points; it is empty.")
    first, _, rest = text.partition("\n")
    n_points = whole_number(first)
    rows = (text if n_points is None else rest).replace(",", " ")
    try:
        table = np.loadtxt(StringIO(rows), ndmin=2)
    except ValueError as error:
        raise DecompositionError(
            f"{path} does not have numbers, the same count on each line; it is"
            " damaged or of another kind."
        ) from error
    if table.shape[1] < 3:
        raise DecompositionError(
            f"{path} does not have three coordinates on each line; it is damaged"
            " or of another kind."
        )
    points, normals = _split(table, n_points)
    if n_points is not None and len(points) != n_points:
        raise DecompositionError(
            f"{path} promises {n_points} points but has {len(table)} lines of"
            " them; it is truncated or damaged."
        )
    if not all_finite(points):
        raise not_finite(path)
    return points, normals


def _split(table: FloatArray, n_points: int | None) -> Points:
    """Return points and normals: normals on the same lines, or after all points."""
    if table.shape[1] == 6:
        points, others = table[:, :3], table[:, 3:]
        return points, None if _are_colors(others) else others
    if table.shape[1] == 3 and n_points is not None and len(table) == 2 * n_points:
        return table[:n_points], table[n_points:]
    return table[:, :3], None


def _are_colors(values: FloatArray) -> bool:
    """Return whether values (N, 3) are red, green and blue, not normals.

    These are bytes, or shares from 0 to 1 where most do not have the length of normals.
    """
    if not ((values >= 0) & (values <= 255)).all():
        return False
    if values.max() > 1:
        return bool((values == np.floor(values)).all())
    off = np.abs(np.linalg.norm(values, axis=1) - 1)
    return bool(values.any() and np.median(off) > _NOT_UNIT)
