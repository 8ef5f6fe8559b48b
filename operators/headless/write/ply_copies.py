"""Copies of objects for .ply: part numbers and colors on the vertices.

The format has no colors of faces. A vertex on the seam between parts is therefore
copied once for each part, so that every face has one color.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ...bridge.mesh.attributes import (
    FloatArray,
    IntArray,
    read_floats,
    read_ints,
    read_labels,
    write_floats,
    write_ints,
)
from ...bridge.mesh.known import corner_faces, corner_vertices
from ...bridge.mesh.points import count_points, is_cloud, positions_of
from ...bridge.parts.palette import UNPAINTED
from ...bridge.stored.names import PART_LAYER
from ...bridge.views.face_sets_and_colors import point_colors
from .one_scene import written_meshes

# Name of the property that holds part numbers in the file.
_NUMBER = "part"


@contextmanager
def ply_copies() -> Iterator[bool]:
    """Make copies of all mesh objects and select them alone; remove them at the end.

    Yields whether UV maps are to be written: Blender writes what is in memory by chance
    for vertices of no face.
    """
    copies = [
        _copy_of_cloud(obj) if is_cloud(obj) else _copy_of_mesh(obj)
        for obj in written_meshes()
    ]
    without = [copy for copy in copies if not copy.data.uv_layers]
    with_uv = len(without) < len(copies) and not any(
        _has_loose_vertices(copy.data) for copy in copies
    )
    # It does so for whole objects without a UV map, too.
    for copy in without if with_uv else ():
        copy.data.uv_layers.new(do_init=False)
    collection = bpy.context.scene.collection
    for obj in bpy.context.view_layer.objects:
        obj.select_set(False)
    for copy in copies:
        collection.objects.link(copy)
        copy.select_set(True)
    try:
        yield with_uv
    finally:
        for copy in copies:
            bpy.data.meshes.remove(copy.data)  # removes the object as well


def _has_loose_vertices(mesh: bpy.types.Mesh) -> bool:
    """Return whether any vertex belongs to no face."""
    return bool(
        (np.bincount(corner_vertices(mesh), minlength=len(mesh.vertices)) == 0).any()
    )


def _copy_of_cloud(obj: bpy.types.Object) -> bpy.types.Object:
    """Return a new object with the points of a cloud, painted by part."""
    parts = read_labels(obj.data, PART_LAYER, "POINT", count_points(obj))
    mesh = bpy.data.meshes.new(obj.name)
    mesh.from_pydata(positions_of(obj), [], [])
    _paint(mesh, point_colors(obj), parts)
    return _object_like(obj, mesh)


def _copy_of_mesh(obj: bpy.types.Object) -> bpy.types.Object:
    """Return a new object with the mesh of another, split at seams and painted."""
    mesh = obj.data
    n_faces = len(mesh.polygons)
    parts = read_labels(mesh, PART_LAYER, "FACE", n_faces)
    slots = read_labels(mesh, "material_index", "FACE", n_faces, missing=0)
    origins, corners = _split_at_seams(mesh, parts)
    faces = corner_faces(mesh)
    part_of_vertex = np.full(len(origins), -1, dtype=np.int32)
    part_of_vertex[corners] = parts[faces]
    colors = _material_colors(mesh)
    color_of_vertex = np.tile(np.array(UNPAINTED, np.float32), (len(origins), 1))
    color_of_vertex[corners] = colors[np.clip(slots, 0, len(colors) - 1)[faces]]
    split = _mesh_on(mesh, positions_of(obj)[origins], corners)
    _paint(split, color_of_vertex, part_of_vertex)
    return _object_like(obj, split)


def _split_at_seams(
    mesh: bpy.types.Mesh, parts: IntArray
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the old vertex of each new one, and the new vertex of each corner.

    In its part of lowest number a vertex keeps its own number. Its copies for other
    parts come after all old vertices.
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


def _mesh_on(
    mesh: bpy.types.Mesh, positions: FloatArray, corners: NDArray[np.int64]
) -> bpy.types.Mesh:
    """Return a mesh with the faces and the UV map of `mesh`, on other vertices."""
    split = bpy.data.meshes.new(mesh.name)
    split.vertices.add(len(positions))
    write_floats(split.vertices, "co", positions)
    split.loops.add(len(corners))
    write_ints(split.loops, "vertex_index", corners)
    split.polygons.add(len(mesh.polygons))
    write_ints(split.polygons, "loop_start", read_ints(mesh.polygons, "loop_start"))
    split.update(calc_edges=True)
    if mesh.uv_layers.active:
        uv = read_floats(mesh.uv_layers.active.uv, "vector", 2)
        write_floats(split.uv_layers.new().uv, "vector", uv)
    return split


def _paint(mesh: bpy.types.Mesh, colors: NDArray[Any], parts: IntArray) -> None:
    """Write the color (V, 4) and the part number (V,) of each vertex."""
    paint = mesh.color_attributes.new("Color", "FLOAT_COLOR", "POINT")
    write_floats(paint.data, "color", colors)
    mesh.color_attributes.active_color = paint
    number = mesh.attributes.new(_NUMBER, "INT", "POINT")
    write_ints(number.data, "value", parts)


def _object_like(obj: bpy.types.Object, mesh: bpy.types.Mesh) -> bpy.types.Object:
    """Return a new object with `mesh` that has the name and place of `obj`."""
    copy = bpy.data.objects.new(obj.name, mesh)
    copy.matrix_world = obj.matrix_world
    return copy


def _material_colors(mesh: bpy.types.Mesh) -> FloatArray:
    """Return the viewport color of each material slot, (M, 4) with M at least 1."""
    colors = [
        tuple(material.diffuse_color) if material else UNPAINTED
        for material in mesh.materials
    ]
    return np.array(colors or [UNPAINTED], dtype=np.float32)
