"""Finds names in the header of a .ply file that Blender does not read."""

from __future__ import annotations

import re

from ..files.headers import Header
from .face_checks import CORNERS, place_of_corners

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
    if any(place_of_corners(each) is None for each in faces):
        return "an element face without vertex_indices or vertex_index"
    for each in header.elements:
        lists_vertices = not each.properties.keys().isdisjoint(CORNERS)
        if lists_vertices and each.name not in ("face", "tristrips") and each.n_rows:
            return f'faces as "element {each.name}" and not as "element face"'
    return None
