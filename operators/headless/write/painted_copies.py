"""Copies with the numbers and colors of parts on vertices, for .ply and clouds in .glb.

.ply has no colors of faces. A vertex on the seam between parts is therefore copied once
for each part, so that every face has one color.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ....core.errors import DecompositionError
from ....core.steps.arrays import Float32Array, Int32Array, IntArray
from ...bridge.mesh.attributes import (
    corner_vertices,
    read_floats,
    read_ints,
    read_labels,
    write_attribute,
    write_floats,
    write_ints,
)
from ...bridge.mesh.known import corner_faces
from ...bridge.mesh.points import count_points, is_cloud, positions_of
from ...bridge.parts.palette import UNPAINTED
from ...bridge.parts.read import find_parts_on
from ...bridge.views.face_sets_and_colors import point_colors
from .one_scene import written_meshes

# Name of the property that holds part numbers in a .ply file.
_NUMBER = "part"
# The same in .glb, where names of attributes have to begin like this.
_GLB_NUMBER = "_PART"
# Blender 4.2 writes colors of points that no reader of .glb can read.
_GLB_HAS_COLORS = bpy.app.version >= (5, 0, 0)
# Ending of the name of a mesh while another one has its name.
_FORMER = ".former"
# Formats whose points have neither colors nor materials.
_NO_POINTS = (".obj", ".fbx")
# Formats whose exporters take points of meshes alone.
_NO_CLOUD_OBJECTS = (*_NO_POINTS, ".glb")


@contextmanager
def ply_copies() -> Iterator[bool]:
    """Make copies of all mesh objects and select them alone; remove them at the end.

    Yields whether UV maps are to be written: Blender writes what is in memory by chance
    for vertices of no face.
    """
    painted = {
        obj: _painted_points(obj, _NUMBER) if is_cloud(obj) else _painted_faces(obj)
        for obj in written_meshes()
    }
    copies = [_object_like(obj, mesh) for obj, mesh in painted.items()]
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


@contextmanager
def painted_clouds() -> Iterator[bool]:
    """Paint the clouds that are meshes by part; take it back at the end.

    Yields whether there are any.
    """
    clouds = [obj for obj in written_meshes() if is_cloud(obj) and obj.type == "MESH"]
    before = {obj: obj.data for obj in clouds}
    names = {mesh: mesh.name for mesh in before.values()}
    try:
        for obj, mesh in before.items():
            obj.data = _painted_points(obj, _GLB_NUMBER, _GLB_HAS_COLORS)
            mesh.name += _FORMER
            obj.data.name = names[mesh]  # files have it
        yield bool(before)
    finally:
        for obj, mesh in before.items():
            painted, obj.data = obj.data, mesh
            if painted is not mesh:
                bpy.data.meshes.remove(painted)
            mesh.name = names[mesh]


def clouds_without_parts(ending: str) -> tuple[str, ...]:
    """Return a sentence for each cloud that files with an ending do not hold in full.

    Raises
    ------
    DecompositionError
        If they hold nothing at all of what is to be written.
    """
    written, lost, partly = written_meshes(), [], []
    for obj in written:
        if obj.type == "POINTCLOUD" and ending in _NO_CLOUD_OBJECTS:
            lost.append(obj.name)
        elif is_cloud(obj) and count_points(obj) and ending in _NO_POINTS:
            partly.append(obj.name)
    if lost and len(lost) == len(written):
        raise DecompositionError(
            f"{lost[0]} is a point cloud object, and {ending} files hold none; write"
            " .ply, .usd or .blend."
        )
    left_out = (
        f"{name} is a point cloud object, which {ending} does not hold: it was left"
        " out; write .ply, .usd or .blend for it."
        for name in lost
    )
    without = (
        f"{name} is a point cloud: {ending} does not hold its parts; write .ply, .usd"
        " or .blend for them."
        for name in partly
    )
    return *left_out, *without


def _has_loose_vertices(mesh: bpy.types.Mesh) -> bool:
    """Return whether any vertex belongs to no face."""
    return bool(
        (np.bincount(corner_vertices(mesh), minlength=len(mesh.vertices)) == 0).any()
    )


def _painted_points(
    obj: bpy.types.Object, number: str, with_colors: bool = True
) -> bpy.types.Mesh:
    """Return a new mesh of a cloud's points, painted by part."""
    mesh = bpy.data.meshes.new(obj.data.name)
    mesh.from_pydata(positions_of(obj), [], [])
    if with_colors:
        _paint(mesh, point_colors(obj))
    _number(mesh, _part_numbers(obj, count_points(obj)), number)
    return mesh


def _part_numbers(obj: bpy.types.Object, n_rows: int) -> Int32Array:
    """Return the number of the part of each face or point, -1 without parts of ours."""
    found = find_parts_on(obj)
    return np.full(n_rows, -1, np.int32) if found is None else found.numbers


def _painted_faces(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return a new mesh with the faces of an object's, split at seams and painted."""
    mesh = obj.data
    parts = _part_numbers(obj, len(mesh.polygons))
    slots = read_labels(mesh, "material_index", missing=0)
    origins, corners = _split_at_seams(mesh, parts)
    faces = corner_faces(mesh)
    part_of_vertex = np.full(len(origins), -1, dtype=np.int32)
    part_of_vertex[corners] = parts[faces]
    colors = _material_colors(mesh)
    color_of_vertex = np.tile(np.array(UNPAINTED, np.float32), (len(origins), 1))
    color_of_vertex[corners] = colors[np.clip(slots, 0, len(colors) - 1)[faces]]
    split = _mesh_on(mesh, positions_of(obj)[origins], corners)
    _paint(split, color_of_vertex)
    _number(split, part_of_vertex, _NUMBER)
    return split


def _split_at_seams(
    mesh: bpy.types.Mesh, parts: Int32Array
) -> tuple[IntArray, IntArray]:
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
    mesh: bpy.types.Mesh, positions: Float32Array, corners: IntArray
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


def _paint(mesh: bpy.types.Mesh, colors: NDArray[Any]) -> None:
    """Write the color (V, 4) of each vertex."""
    paint = mesh.color_attributes.new("Color", "FLOAT_COLOR", "POINT")
    write_floats(paint.data, "color", colors)
    mesh.color_attributes.active_color = paint


def _number(mesh: bpy.types.Mesh, parts: Int32Array, name: str) -> None:
    """Write the number of the part (V,) of each vertex to an attribute."""
    write_attribute(mesh, name, "INT", "POINT", parts)


def _object_like(obj: bpy.types.Object, mesh: bpy.types.Mesh) -> bpy.types.Object:
    """Return a new object with the name of `obj` and `mesh`, moved to its place.

    The mesh itself is moved: an object without a parent has no shear. Faces of mirrored
    objects are turned around, which the exporter does not do.
    """
    mesh.transform(obj.matrix_world)
    if obj.matrix_world.determinant() < 0:
        mesh.flip_normals()
    return bpy.data.objects.new(obj.name, mesh)


def _material_colors(mesh: bpy.types.Mesh) -> Float32Array:
    """Return the viewport color of each material slot, (M, 4) with M at least 1."""
    colors = [
        tuple(material.diffuse_color) if material else UNPAINTED
        for material in mesh.materials
    ]
    return np.array(colors or [UNPAINTED], dtype=np.float32)
