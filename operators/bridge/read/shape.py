"""Blender objects -> shapes."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from ....core.errors import DecompositionError
from ....core.geometry.mesh import TriangleMesh
from ....core.geometry.point_cloud import PointCloud
from ..mesh.points import is_cloud, normals_of, positions_of
from ..parts.explode_slider import exploding
from .converting import CONVERTIBLE, mesh_of
from .target import flush_edits

# Scales that differ by less are the same scale in Blender's single precision.
_SAME_SCALE = 1e-5


def read_shape(obj: bpy.types.Object) -> TriangleMesh | PointCloud:
    """Return an object's own mesh, without modifiers, in triangles, or its points.

    Coordinates are those of object space; if the scale of the object stretches the
    mesh, they are stretched likewise, because samples are spread over the shape that
    the user sees. Mirroring changes no line of sight and is left out, so that
    triangles keep their winding.
    """
    if is_cloud(obj):
        return _read_cloud(obj)
    flush_edits(obj)
    with mesh_of(obj) as mesh:
        return _read_mesh(mesh, stretch(obj))


def _read_mesh(mesh: bpy.types.Mesh, factors: NDArray[np.float64]) -> TriangleMesh:
    """Return the triangles of a mesh, stretched."""
    mesh.calc_loop_triangles()
    vertices = np.empty(len(mesh.vertices) * 3, dtype=np.float32)
    mesh.vertices.foreach_get("co", vertices)
    triangles = np.empty(len(mesh.loop_triangles) * 3, dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    polygons = np.empty(len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangle_polygons.foreach_get("value", polygons)
    return TriangleMesh(
        vertices.reshape(-1, 3).astype(np.float64) * factors,
        triangles.reshape(-1, 3).astype(np.int64),
        polygons.astype(np.int64),
    )


def selected_faces(obj: bpy.types.Object) -> NDArray[np.bool_]:
    """Return which faces of a mesh are selected, (P,)."""
    flush_edits(obj)
    selected = np.zeros(len(obj.data.polygons), dtype=bool)
    obj.data.polygons.foreach_get("select", selected)
    return selected


def _read_cloud(obj: bpy.types.Object) -> PointCloud:
    """Return the points of a cloud, with their normals if it has any."""
    factors, normals = stretch(obj), normals_of(obj)
    points = positions_of(obj).astype(np.float64) * factors
    if normals is not None:  # normals stretch the other way
        normals = normals.astype(np.float64) / factors
    return PointCloud(points, normals)


def reading_notes(obj: bpy.types.Object) -> tuple[str, ...]:
    """Return what the user should know about what was read of an object."""
    if obj.type in CONVERTIBLE:
        return (
            f'Parts are on faces: they are on the new mesh object "{obj.name} parts",'
            f" and {obj.name} is as it was.",
        )
    notes = []
    modifiers = [
        modifier.name
        for modifier in obj.modifiers
        if modifier.show_viewport and modifier != exploding(obj)
    ]
    if modifiers:
        notes.append(
            "The mesh was read without its modifiers"
            f" ({', '.join(modifiers)}); apply them first to include them."
        )
    keys = getattr(obj.data, "shape_keys", None)  # point clouds know none
    if keys and any(key.value for key in keys.key_blocks):
        notes.append("The mesh was read in its Basis shape, without shape keys.")
    sharers = sum(other.data == obj.data for other in bpy.data.objects)
    if sharers > 1:
        notes.append(
            f"{sharers} objects share this mesh: the parts show on all of them."
        )
    return tuple(notes)


def stretch(obj: bpy.types.Object) -> NDArray[np.float64]:
    """Return the factor of each axis, 1 throughout if the scale is uniform."""
    scale = np.abs(np.array(obj.matrix_world.to_scale(), dtype=np.float64))
    if not np.isfinite(scale).all() or not scale.all():
        raise DecompositionError(
            "The object's scale is zero or not a number along an axis; give it a"
            " scale in Sidebar > Item."
        )
    if scale.max() - scale.min() <= _SAME_SCALE * scale.max():
        return np.ones(3)
    return scale
