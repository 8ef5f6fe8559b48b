"""Copies of meshes for formats with colors on vertices but none on faces.

A vertex on a seam belongs to several parts. In the copies it is there once for each
of them, so that every face has one color.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np
from numpy.typing import NDArray

from ...bridge.mesh.corners import corner_faces, corner_vertices
from ...bridge.mesh.points import count_points, is_cloud, positions_of
from ...bridge.parts.palette import part_color
from ...bridge.stored.names import PART_LAYER
from ..read.models import mesh_objects

_NUMBER = "part"
_UNPAINTED = (0.8, 0.8, 0.8, 1.0)


@contextmanager
def split_at_seams() -> Iterator[None]:
    """Select copies of all mesh objects, split and painted, for an exporter."""
    copies = [
        _copy_of_points(obj) if is_cloud(obj) else _copy(obj) for obj in mesh_objects()
    ]
    collection = bpy.context.scene.collection
    for obj in bpy.context.view_layer.objects:
        obj.select_set(False)
    for copy in copies:
        collection.objects.link(copy)
        copy.select_set(True)
    try:
        yield
    finally:
        for copy in copies:
            bpy.data.meshes.remove(copy.data)  # and with it the object


def _copy_of_points(obj: bpy.types.Object) -> bpy.types.Object:
    """Return a new object of the points of a cloud, painted."""
    mesh = bpy.data.meshes.new(obj.name)
    mesh.from_pydata(positions_of(obj), [], [])
    copy = bpy.data.objects.new(obj.name, mesh)
    copy.matrix_world = obj.matrix_world
    parts = np.full(count_points(obj), -1, dtype=np.int32)
    source = obj.data.attributes.get(PART_LAYER)
    if source is not None:
        source.data.foreach_get("value", parts)
    colors = np.array([part_color(part) for part in range(parts.max() + 1)])
    colors = np.concatenate([colors.reshape(-1, 4), [_UNPAINTED]])  # at -1
    paint = mesh.color_attributes.new("Color", "FLOAT_COLOR", "POINT")
    paint.data.foreach_set("color", colors[parts].astype(np.float32).ravel())
    mesh.color_attributes.active_color = paint
    number = mesh.attributes.new(_NUMBER, "INT", "POINT")
    number.data.foreach_set("value", parts)
    return copy


def _copy(obj: bpy.types.Object) -> bpy.types.Object:
    """Return a new object like `obj`, with its mesh split and painted."""
    mesh = obj.data
    parts = _face_values(mesh, PART_LAYER)
    origins, corners = _split(mesh, parts)
    split = _mesh(mesh, origins, corners)
    n_faces = len(mesh.polygons)
    part_of_vertex = np.full(len(origins), -1, dtype=np.int32)
    part_of_vertex[corners] = parts[corner_faces(mesh)]
    colors = _material_colors(mesh)
    slots = np.clip(_face_values(mesh, "material_index", 0), 0, len(colors) - 1)
    color_of_vertex = np.tile(np.array(_UNPAINTED, np.float32), (len(origins), 1))
    if n_faces:
        color_of_vertex[corners] = colors[slots[corner_faces(mesh)]]
    paint = split.color_attributes.new("Color", "FLOAT_COLOR", "POINT")
    paint.data.foreach_set("color", color_of_vertex.ravel())
    split.color_attributes.active_color = paint
    number = split.attributes.new(_NUMBER, "INT", "POINT")
    number.data.foreach_set("value", part_of_vertex)
    copy = bpy.data.objects.new(obj.name, split)
    copy.matrix_world = obj.matrix_world
    return copy


def _split(
    mesh: bpy.types.Mesh, parts: NDArray[np.int32]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the old vertex of each new one, and the new vertex of each corner.

    Vertices keep their number in the part of lowest number; further copies follow.
    """
    n_vertices = len(mesh.vertices)
    vertex, part = corner_vertices(mesh), parts[corner_faces(mesh)]
    pairs = np.stack([vertex, part], axis=1).astype(np.int64)
    unique, pair_of_corner = np.unique(pairs, axis=0, return_inverse=True)
    first = np.r_[True, np.diff(unique[:, 0]) > 0] if len(unique) else np.zeros(0, bool)
    number = unique[:, 0].copy()
    number[~first] = n_vertices + np.arange(np.count_nonzero(~first))
    origins = np.r_[np.arange(n_vertices), unique[~first, 0]]
    return origins, number[pair_of_corner.reshape(-1)]


def _mesh(
    mesh: bpy.types.Mesh, origins: NDArray[np.int64], corners: NDArray[np.int64]
) -> bpy.types.Mesh:
    """Return a mesh with the faces of `mesh` on other vertices."""
    positions = np.empty(len(mesh.vertices) * 3, dtype=np.float32)
    mesh.vertices.foreach_get("co", positions)
    starts = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("loop_start", starts)
    split = bpy.data.meshes.new(mesh.name)
    split.vertices.add(len(origins))
    split.vertices.foreach_set("co", positions.reshape(-1, 3)[origins].ravel())
    split.loops.add(len(corners))
    split.loops.foreach_set("vertex_index", corners.astype(np.int32))
    split.polygons.add(len(starts))
    split.polygons.foreach_set("loop_start", starts)
    split.update(calc_edges=True)
    if mesh.uv_layers.active:
        uv = np.empty(len(corners) * 2, dtype=np.float32)
        mesh.uv_layers.active.uv.foreach_get("vector", uv)
        split.uv_layers.new().uv.foreach_set("vector", uv)
    return split


def _face_values(
    mesh: bpy.types.Mesh, name: str, missing: int = -1
) -> NDArray[np.int32]:
    """Return an attribute of the faces, `missing` throughout if it is not there."""
    values = np.full(len(mesh.polygons), missing, dtype=np.int32)
    attribute = mesh.attributes.get(name)
    if attribute is not None and attribute.domain == "FACE":
        attribute.data.foreach_get("value", values)
    return values


def _material_colors(mesh: bpy.types.Mesh) -> NDArray[np.float32]:
    """Return the viewport color of each material slot, at least one."""
    colors = [
        tuple(material.diffuse_color) if material else _UNPAINTED
        for material in mesh.materials
    ]
    return np.array(colors or [_UNPAINTED], dtype=np.float32)
