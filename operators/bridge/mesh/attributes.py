"""Numbers of a mesh's elements as arrays: Blender's `foreach_get` and `foreach_set`.

Elements are `mesh.vertices`, `mesh.polygons`, `attribute.data` and the like. Blender
copies an array in one go if its type is the property's own: int32, float32 or bool.
Any other type is converted value by value, which is 20 times slower.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import DTypeLike, NDArray

from ....core.steps.arrays import BoolArray, Float32Array, Int32Array

# How Blender names the values of an attribute of each type, and how many numbers each
# has.
_FIELDS = {
    "FLOAT": ("value", 1),
    "INT": ("value", 1),
    "INT8": ("value", 1),
    "BOOLEAN": ("value", 1),
    "FLOAT_VECTOR": ("vector", 3),
    "FLOAT2": ("vector", 2),
    "FLOAT_COLOR": ("color", 4),
    "BYTE_COLOR": ("color", 4),
    "INT16_2D": ("value", 2),
    "INT32_2D": ("value", 2),
    "QUATERNION": ("value", 4),
    "FLOAT4X4": ("value", 16),
}


def read_ints(elements: Any, name: str, width: int = 1) -> Int32Array:
    """Return a property of N elements.

    Parameters
    ----------
    elements : bpy_prop_collection
    name : str
        For example "vertex_index" of loops, or "value" of an attribute's data.
    width : int
        How many numbers each element has.

    Returns
    -------
    (N,) int32, or (N, width) int32 if `width` is more than 1
    """
    return _read(elements, name, width, np.int32)


def read_floats(elements: Any, name: str, width: int = 1) -> Float32Array:
    """Return a property of N elements, float32; shapes are those of `read_ints`."""
    return _read(elements, name, width, np.float32)


def read_flags(elements: Any, name: str) -> BoolArray:
    """Return a property of N elements that is true or false, (N,) bool."""
    return _read(elements, name, 1, np.bool_)


def write_ints(elements: Any, name: str, values: NDArray[np.integer[Any]]) -> None:
    """Write a property of N elements, from (N,) or (N, width) integers."""
    elements.foreach_set(name, values.astype(np.int32).ravel())


def write_floats(elements: Any, name: str, values: NDArray[np.floating[Any]]) -> None:
    """Write a property of N elements, from (N,) or (N, width) floats."""
    elements.foreach_set(name, values.astype(np.float32).ravel())


def write_flags(elements: Any, name: str, values: BoolArray) -> None:
    """Write a property of N elements that is true or false, from (N,) bool."""
    elements.foreach_set(name, values)


def read_labels(mesh: Any, name: str, missing: int) -> Int32Array:
    """Return an integer attribute of the faces, (P,); all are `missing` without it."""
    found = read_attribute(mesh, name, "INT", "FACE")
    if found is not None:
        return found
    return np.full(len(mesh.polygons), missing, dtype=np.int32)


def read_attribute(data: Any, name: str, kind: str, domain: str) -> NDArray[Any] | None:
    """Return an attribute as an array, None if there is none of that kind and domain.

    The `data` are a mesh or a point cloud. The kind is INT, FLOAT_VECTOR and the like,
    and the domain POINT, EDGE, FACE or CORNER.
    """
    attribute = data.attributes.get(name)
    if attribute is None or (attribute.data_type, attribute.domain) != (kind, domain):
        return None
    return values_of(attribute)


def values_of(attribute: Any) -> NDArray[Any]:
    """Return the values of an attribute of any kind."""
    kind = attribute.data_type
    if kind not in _FIELDS:
        return np.array([str(each.value) for each in attribute.data])
    if kind == "BOOLEAN":
        return read_flags(attribute.data, "value")
    read = read_ints if "INT" in kind else read_floats
    return read(attribute.data, *_FIELDS[kind])


def write_attribute(
    data: Any, name: str, kind: str, domain: str, values: NDArray[Any]
) -> None:
    """Write an attribute of integers or floats; make it if there is none."""
    attribute = data.attributes.get(name)
    if attribute is None:
        attribute = data.attributes.new(name, kind, domain)
    write = write_ints if "INT" in kind else write_floats
    write(attribute.data, _FIELDS[kind][0], values)


def vertex_positions(mesh: bpy.types.Mesh) -> Float32Array:
    """Return the positions of the vertices, (V, 3)."""
    places = mesh.attributes.get("position")
    if places is None or mesh.is_editmode:  # attributes look empty in Edit Mode
        return read_floats(mesh.vertices, "co", 3)
    return read_floats(places.data, "vector", 3)  # a hundred times faster


def corner_vertices(mesh: bpy.types.Mesh) -> Int32Array:
    """Return the vertex of each corner, (C,)."""
    return _of_corners(mesh, ".corner_vert", "vertex_index")


def corner_edges(mesh: bpy.types.Mesh) -> Int32Array:
    """Return the edge from each corner to the next one of its face, (C,)."""
    return _of_corners(mesh, ".corner_edge", "edge_index")


def _of_corners(mesh: bpy.types.Mesh, attribute: str, name: str) -> Int32Array:
    """Return an attribute of the corners, or the property with the same numbers."""
    corners = mesh.attributes.get(attribute)
    if corners is None or mesh.is_editmode:  # attributes look empty in Edit Mode
        return read_ints(mesh.loops, name)
    return read_ints(corners.data, "value")  # a hundred times faster


def _read(elements: Any, name: str, width: int, dtype: DTypeLike) -> NDArray[Any]:
    values = np.empty(len(elements) * width, dtype=dtype)
    elements.foreach_get(name, values)
    return values if width == 1 else values.reshape(-1, width)
