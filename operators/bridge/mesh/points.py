"""Objects that are point clouds: point cloud objects, and meshes of nothing but points.

The latter is what Blender makes of a scan in a .ply file.
"""

from __future__ import annotations

import bmesh
import bpy
import numpy as np
from numpy.typing import NDArray

# Attributes that hold normals, by the programs and importers that write them.
_NORMALS = ("normal", "Normal", "normals", "Normals", "custom_normal", "N")
_NORMALS_BY_AXIS = ("nx", "ny", "nz")
# Where Blender keeps the values of an attribute, and how many numbers each has.
_FIELDS = {
    "FLOAT": ("value", 1),
    "FLOAT_VECTOR": ("vector", 3),
    "FLOAT_COLOR": ("color", 4),
}


def is_cloud(obj: bpy.types.Object) -> bool:
    """Return whether an object is a point cloud."""
    if obj.type == "POINTCLOUD":
        return True
    mesh = obj.data
    return obj.type == "MESH" and not (mesh.polygons or mesh.edges)


def count_points(obj: bpy.types.Object) -> int:
    """Return the number of points, or vertices, of an object."""
    return len(obj.data.points if obj.type == "POINTCLOUD" else obj.data.vertices)


def positions_of(obj: bpy.types.Object) -> NDArray[np.float32]:
    """Return the points, or vertices, of an object in its own space, (N, 3)."""
    values = np.zeros(count_points(obj) * 3, dtype=np.float32)
    attribute = obj.data.attributes.get("position")
    if attribute is not None:  # there is none without points
        attribute.data.foreach_get("vector", values)
    return values.reshape(-1, 3)


def vertices_now(obj: bpy.types.Object) -> NDArray[np.float32]:
    """Return `positions_of` an object, as they are in Edit Mode if it is edited."""
    if obj.mode != "EDIT" or obj.type != "MESH":
        return positions_of(obj)
    vertices = bmesh.from_edit_mesh(obj.data).verts
    return np.array([v.co for v in vertices], dtype=np.float32).reshape(-1, 3)


def normals_of(obj: bpy.types.Object) -> NDArray[np.float32] | None:
    """Return the normals of a cloud, (N, 3), None if no attribute holds them."""
    for name in _NORMALS:
        normals = read_vectors(obj, name)
        if normals is not None:
            return normals
    columns = [_read(obj, name, "FLOAT") for name in _NORMALS_BY_AXIS]
    if any(column is None for column in columns):
        return None
    return np.concatenate(columns, axis=1)


def read_vectors(obj: bpy.types.Object, name: str) -> NDArray[np.float32] | None:
    """Return an attribute of vectors of the points, (N, 3), None if there is none."""
    return _read(obj, name, "FLOAT_VECTOR")


def _read(obj: bpy.types.Object, name: str, kind: str) -> NDArray[np.float32] | None:
    """Return an attribute of the points by its kind, (N, d), None if there is none."""
    attribute = obj.data.attributes.get(name)
    if attribute is None or (attribute.data_type, attribute.domain) != (kind, "POINT"):
        return None
    field, width = _FIELDS[kind]
    values = np.empty(len(attribute.data) * width, dtype=np.float32)
    attribute.data.foreach_get(field, values)
    return values.reshape(-1, width)


def set_points(
    obj: bpy.types.Object, name: str, kind: str, values: NDArray[np.float64]
) -> None:
    """Write an attribute of the points: FLOAT_COLOR (N, 4) or FLOAT_VECTOR (N, 3)."""
    attribute = obj.data.attributes.get(name)
    if attribute is None:
        attribute = obj.data.attributes.new(name, kind, "POINT")
    field, _ = _FIELDS[kind]
    attribute.data.foreach_set(field, values.astype(np.float32).ravel())
