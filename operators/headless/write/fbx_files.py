"""Writes .fbx files with hulls that Unreal recognizes, the same bytes in every run."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import bpy

from ....core.errors import DecompositionError
from ....core.parameters.hull_names import hull_names
from ...bridge.hulls.fitting_names import names_that_fit
from ...bridge.stored.noted_hulls import figures_on
from ..formats import FBX, enable
from ..shear import in_their_places, shear_in_meshes, without_parents
from .names import hulls_by_owner
from .one_scene import one_scene

# A binary .fbx file begins with words and its version. Then come nodes: end, number of
# properties, their length, length of the name, name. A property begins with its type.
_HEAD = 27
_NODE = struct.Struct("<IIIB")
_WIDE_NODE = struct.Struct("<QQQB")
_WIDE_FROM = 7500
_WIDTHS = {b"C": 1, b"B": 1, b"Y": 2, b"I": 4, b"F": 4, b"D": 8, b"L": 8}
_TIME = {
    **{"Version": 1000, "Year": 1970, "Month": 1, "Day": 1, "Hour": 10},
    **{"Minute": 0, "Second": 0, "Millisecond": 0},
}
_LONG = struct.Struct("<q")
_INT = struct.Struct("<i")


def write_fbx(path: Path, hulls: Sequence[bpy.types.Object]) -> None:
    """Write the scene with its hulls.

    Unreal takes a mesh UCX_Name_01 for a hull of the mesh Name, and not if it hangs on
    another object. Hulls with plain names are therefore named like that in the file,
    and all hulls are beside their objects, in the same place.

    Raises
    ------
    DecompositionError
        If a hull cannot have the name that Unreal needs.
    """
    enable(FBX)
    with (
        shear_in_meshes(hulls),
        _for_unreal(hulls),
        one_scene(hulls) as objects,
        in_their_places(objects),
    ):
        bpy.ops.export_scene.fbx(
            filepath=str(path),
            use_custom_props=True,
            # Parts and hulls belong to the faces without modifiers.
            use_mesh_modifiers=False,
            mesh_smooth_type="FACE",
            add_leaf_bones=False,
        )
    path.write_bytes(without_chance(path.read_bytes()))


@contextmanager
def _for_unreal(hulls: Sequence[bpy.types.Object]) -> Iterator[None]:
    """Give hulls Unreal's names and no parents; take it back at the end."""
    before = [(hull, hull.name) for hull in hulls]
    try:
        for hull, name in zip(hulls, _unreal_names(hulls), strict=True):
            if hull.name != name:
                hull.name = name
            if hull.name != name:  # Blender cuts it off, or numbers it
                raise DecompositionError(
                    f"A hull cannot be named {name}, as Unreal needs it: the name is"
                    " taken or too long; rename the object."
                )
        with without_parents(hulls):
            yield
    finally:
        for hull, name in before:
            hull.name = name


def _unreal_names(hulls: Sequence[bpy.types.Object]) -> list[str]:
    """Return Unreal's name for each hull with a plain name; others keep theirs."""
    names: dict[bpy.types.Object, str] = {}
    for obj, its_hulls in hulls_by_owner(hulls).items():
        kinds = [figures_on(hull).get("kind", "HULL") for hull in its_hulls]
        plain = names_that_fit(obj, "PLAIN", "", kinds)
        unreal = hull_names("UNREAL", "", obj.name, kinds)
        for hull, usual, name in zip(its_hulls, plain, unreal, strict=True):
            names[hull] = name if hull.name == usual else hull.name
    return [names[hull] for hull in hulls]


@dataclass(frozen=True)
class _Node:
    """A node of an .fbx file: its path, and the place and type of each property."""

    path: tuple[str, ...]
    properties: tuple[tuple[bytes, int], ...]


def without_chance(data: bytes) -> bytes:
    """Return a binary .fbx file without what differs between two runs.

    Blender's exporter writes the time, and identifiers that depend on the seed of
    Python's hashes. They become the same time, and numbers in their order.

    Parameters
    ----------
    data : bytes
        The file.

    Returns
    -------
    bytes
        Of the same length.
    """
    (version,) = struct.unpack_from("<I", data, _HEAD - 4)
    nodes = list(_nodes(data, _HEAD, (), version >= _WIDE_FROM))
    found = bytearray(data)
    numbers = {0: 0}  # the scene itself
    for node in nodes:
        for kind, place in node.properties:
            if kind == b"L" and _holds_identifiers(node, place):
                (identifier,) = _LONG.unpack_from(data, place)
                number = numbers.setdefault(identifier, 1000 + len(numbers))
                _LONG.pack_into(found, place, number)
            elif kind == b"I" and "CreationTimeStamp" in node.path[:-1]:
                _INT.pack_into(found, place, _TIME[node.path[-1]])
    return bytes(found)


def _holds_identifiers(node: _Node, place: int) -> bool:
    """Return whether a whole number of a node is an identifier."""
    parent, name = node.path[:-1], node.path[-1]
    if parent in (("Objects",), ("Documents",)):
        return place == node.properties[0][1]
    in_a_pose = parent[-1:] == ("PoseNode",) and name == "Node"
    return parent == ("Connections",) or in_a_pose


def _nodes(
    data: bytes, start: int, parent: tuple[str, ...], wide: bool
) -> Iterator[_Node]:
    """Yield the nodes that begin at `start`, and all nodes within them."""
    form = _WIDE_NODE if wide else _NODE
    while True:
        end, count, length, n_name = form.unpack_from(data, start)
        if end == 0:
            return
        place = start + form.size + n_name
        path = (*parent, data[place - n_name : place].decode("ascii", "replace"))
        inner, properties = place + length, []
        for _ in range(count):
            kind = data[place : place + 1]
            properties.append((kind, place + 1))
            place += 1 + _length_of(data, kind, place + 1)
        yield _Node(path, tuple(properties))
        if inner < end:
            yield from _nodes(data, inner, path, wide)
        start = end


def _length_of(data: bytes, kind: bytes, place: int) -> int:
    """Return the number of bytes of a property, after its type."""
    if kind in _WIDTHS:
        return _WIDTHS[kind]
    if kind in b"SR":  # texts and raw bytes
        return 4 + int(struct.unpack_from("<I", data, place)[0])
    return 12 + int(struct.unpack_from("<III", data, place)[2])  # arrays
