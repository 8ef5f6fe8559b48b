"""Point clouds: point cloud objects, and meshes without edges and faces.

Blender makes such a mesh of a scan in a .ply file.
"""

from __future__ import annotations

import bmesh
import bpy
import numpy as np

from ....core.steps.arrays import Float32Array
from .attributes import read_attribute, read_floats, vertex_positions

# Names that programs and importers give to attributes with normals.
_NORMALS = ("normal", "Normal", "normals", "Normals", "custom_normal", "N")
_NORMALS_BY_AXIS = ("nx", "ny", "nz")


def is_cloud(obj: bpy.types.Object) -> bool:
    """Return whether an object is a point cloud."""
    if obj.type == "POINTCLOUD":
        return True
    mesh = obj.data
    return obj.type == "MESH" and not (mesh.polygons or mesh.edges)


def count_points(obj: bpy.types.Object) -> int:
    """Return the number of points, or vertices, of an object."""
    return len(obj.data.points if obj.type == "POINTCLOUD" else obj.data.vertices)


def positions_of(obj: bpy.types.Object) -> Float32Array:
    """Return the points, or vertices, of an object in its own space, (N, 3)."""
    if obj.type == "MESH":
        return vertex_positions(obj.data)
    attribute = obj.data.attributes.get("position")
    if attribute is None:  # Blender has none without points
        return np.zeros((count_points(obj), 3), dtype=np.float32)
    return read_floats(attribute.data, "vector", 3)


def vertices_now(obj: bpy.types.Object) -> Float32Array:
    """Return the points, or vertices, of an object as Edit Mode has them, (N, 3)."""
    if obj.mode != "EDIT" or obj.type != "MESH":
        return positions_of(obj)
    vertices = bmesh.from_edit_mesh(obj.data).verts
    return np.array([v.co for v in vertices], dtype=np.float32).reshape(-1, 3)


def normals_of(obj: bpy.types.Object) -> Float32Array | None:
    """Return the normals of a cloud, (N, 3), None if no attribute holds them."""
    data = obj.data
    for name in _NORMALS:
        normals = read_attribute(data, name, "FLOAT_VECTOR", "POINT")
        if normals is not None:
            return normals
    columns = [read_attribute(data, n, "FLOAT", "POINT") for n in _NORMALS_BY_AXIS]
    found = [column for column in columns if column is not None]
    return np.stack(found, axis=1) if len(found) == len(columns) else None
