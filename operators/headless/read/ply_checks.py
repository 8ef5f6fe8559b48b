"""Finds names in .ply files that Blender does not read, and faces without vertices.

Blender leaves such faces out without a word, reads other memory or crashes.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....core.steps.arrays import IntArray
from ..files.headers import Element, Header
from ..files.text import whole_number

# What the list of the vertices of a face is called, unless it is all that a face has.
_CORNERS = ("vertex_indices", "vertex_index")
# The words of a header line but the names that its author chose.
_WORDS = re.compile(
    rb"^(?:format[ \t]+\w+|element[ \t]+(?:vertex|face)\b|element"
    rb"|property(?:[ \t]+list[ \t]+\w+)?[ \t]+\w+|end_header)",
    re.IGNORECASE | re.MULTILINE,
)
_AXES = {*"xyz"}


def misnamed(header: Header | None, data: bytes) -> str | None:
    """Return what a .ply file has instead of names that Blender reads, None without.

    Parameters
    ----------
    header : Header or None
        As it is read; None if it is damaged.
    data : bytes
        The whole file.
    """
    for words in _WORDS.findall(data[: header.size] if header else data):
        if words != words.lower():
            return f'"{words.decode("latin-1")}"'
    if header is None:
        return None
    vertices = [each.properties for each in header.elements if each.name == "vertex"]
    if not any(each.keys() >= _AXES for each in vertices):
        return "no element vertex with x, y and z"
    faces = [each for each in header.elements if each.name == "face" and each.n_rows]
    if any(_place_of_corners(each) is None for each in faces):
        return "an element face without vertex_indices or vertex_index"
    for each in header.elements:
        lists_vertices = not each.properties.keys().isdisjoint(_CORNERS)
        if lists_vertices and each.name not in ("face", "tristrips") and each.n_rows:
            return f'faces as "element {each.name}" and not as "element face"'
    return None


def refers_to_missing(header: Header, data: bytes) -> bool:
    """Return whether a face has a vertex that the file does not have.

    The `data` are the whole file, which has all rows that its header promises.
    """
    n_vertices = sum(each.n_rows for each in header.elements if each.name == "vertex")
    read = _text_corners if not header.order else _binary_corners
    corners = read(header, data)
    return not ((corners >= 0) & (corners < n_vertices)).all()


def _place_of_corners(element: Element) -> int | None:
    """Return which property of a face lists its vertices, None if there is none."""
    if element.name != "face" or not element.n_rows:
        return None
    for place, (name, codes) in enumerate(element.properties.items()):
        is_ours = name in _CORNERS or len(element.properties) == 1
        if is_ours and len(codes) > 1:
            return place
    return None


def _text_corners(header: Header, data: bytes) -> NDArray[Any]:
    """Return the vertices of all faces of a file in text form, of any shape."""
    rows = [row for row in data[header.size :].splitlines() if row.strip()]
    found: list[bytes] = []
    for element in header.elements:
        place = _place_of_corners(element)
        if place is not None:
            kinds = list(element.properties.values())
            table = _equal_rows(rows[: element.n_rows]) if len(kinds) == 1 else None
            if table is not None:
                return table
            for row in rows[: element.n_rows]:
                found += _listed_last(row.split(), kinds[: place + 1])
        del rows[: element.n_rows]
    try:
        return np.array(found, dtype=np.float64)
    except ValueError:  # such as "1-2", which the importer decides on
        return np.zeros(0)


def _equal_rows(rows: Sequence[bytes]) -> IntArray | None:
    """Return the members of lists of whole numbers; None if they differ in length."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)  # of other words
            numbers = np.fromstring(b" ".join(rows), dtype=np.int64, sep=" ")
    except (ValueError, DeprecationWarning):
        return None
    if not len(numbers) or len(numbers) % len(rows):
        return None
    table = numbers.reshape(len(rows), -1)
    is_equal = (table[:, 0] == table.shape[1] - 1).all()
    return table[:, 1:] if is_equal else None


def _listed_last(words: list[bytes], kinds: Sequence[str]) -> list[bytes]:
    """Return the members of a list, the last of several properties on a line.

    If the line ends before, it is one that no file has.
    """
    start = end = 0
    for codes in kinds:
        start = end + 1
        length = words[end] if len(codes) > 1 and end < len(words) else b""
        end = start + (whole_number(length.decode("latin-1")) or 0)
    return words[start:end] if end <= len(words) else [b"-1"]


def _binary_corners(header: Header, data: bytes) -> NDArray[Any]:
    """Return the vertices of all faces of a file in binary form, of any shape."""
    start = header.size
    for element in header.elements:
        place = _place_of_corners(element)
        table = element.table(header.order, data, start)
        if table is not None:
            if place is not None:
                found: NDArray[Any] = table[f"members {place}"]
                return found
            start += table.nbytes
            continue
        pieces, start = element.walk(header.order, data, start, place)
        if place is not None:
            code = list(element.properties.values())[place][1]
            return np.frombuffer(b"".join(pieces), header.order + code)
    return np.zeros(0)
