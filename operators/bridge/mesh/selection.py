"""Select and hide faces and edges, in Object and in Edit Mode.

In Edit Mode the mesh is a BMesh. In Object Mode the mesh keeps flags, which Edit Mode
starts from.
"""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import numpy as np

from ....core.steps.arrays import BoolArray, Int32Array, IntArray
from .attributes import (
    corner_edges,
    corner_vertices,
    read_flags,
    read_ints,
    write_flags,
)
from .known import corner_faces
from .layers import flush_edits


def select_faces(obj: bpy.types.Object, chosen: BoolArray, extend: bool) -> None:
    """Select faces, and nothing else unless `extend`; hidden ones stay unselected."""
    mesh = obj.data
    if mesh.is_editmode:
        _select_in_edit_mode(mesh, "faces", chosen, extend)
        return
    chosen = chosen & ~read_flags(mesh.polygons, "hide")
    of_faces = chosen[corner_faces(mesh)]
    vertices, edges = corner_vertices(mesh)[of_faces], corner_edges(mesh)[of_faces]
    _select(mesh.vertices, _flags(len(mesh.vertices), vertices), extend)
    _select(mesh.edges, _flags(len(mesh.edges), edges), extend)
    _select(mesh.polygons, chosen, extend)
    show_flags(mesh)


def selected_faces(obj: bpy.types.Object) -> BoolArray:
    """Return which faces of a mesh are selected, (P,)."""
    flush_edits(obj)
    return read_flags(obj.data.polygons, "select")


def select_edges(obj: bpy.types.Object, chosen: BoolArray, extend: bool) -> None:
    """Select edges, and nothing else unless `extend`; hidden ones stay unselected.

    If Blender is in face select mode, it is set to edge select mode.
    """
    mesh = obj.data
    settings = bpy.context.scene.tool_settings
    if settings.mesh_select_mode[:] == (False, False, True):
        settings.mesh_select_mode = (False, True, False)
    if mesh.is_editmode:
        _select_in_edit_mode(mesh, "edges", chosen, extend)
        return
    chosen = chosen & ~read_flags(mesh.edges, "hide")
    ends = read_ints(mesh.edges, "vertices", 2)[chosen].ravel()
    _select(mesh.vertices, _flags(len(mesh.vertices), ends), extend)
    _select(mesh.edges, chosen, extend)
    _select(mesh.polygons, np.zeros(len(mesh.polygons), dtype=bool), extend)
    show_flags(mesh)


def isolate_parts(obj: bpy.types.Object, labels: IntArray, chosen: list[int]) -> None:
    """Hide the faces of all parts but the chosen ones, in Edit Mode.

    What is hidden stays so. But a chosen part is shown if none of its faces is: then it
    was hidden with others, when other parts were isolated.

    Parameters
    ----------
    obj : bpy.types.Object
    labels : (P,) int
        The part of each face.
    chosen : list of int
    """
    bm = bmesh.from_edit_mesh(obj.data)
    seen = np.array([not face.hide for face in bm.faces], dtype=bool)
    others = ~np.isin(labels, chosen)
    back = ~others & ~np.isin(labels, labels[seen])
    for face, is_other, is_back in zip(
        bm.faces, others.tolist(), back.tolist(), strict=True
    ):
        if is_other or is_back:
            face.hide_set(is_other)
    show_flags(obj.data)


def show_all(obj: bpy.types.Object) -> None:
    """Show all faces, edges and vertices of a mesh in Edit Mode."""
    bm = bmesh.from_edit_mesh(obj.data)
    for element in (*bm.verts, *bm.edges, *bm.faces):
        element.hide_set(False)
    show_flags(obj.data)


def _flags(size: int, rows: Int32Array) -> BoolArray:
    """Return an array that is true in these rows."""
    flags = np.zeros(size, dtype=bool)
    flags[rows] = True
    return flags


def _select(elements: Any, chosen: BoolArray, extend: bool) -> None:
    """Select vertices, edges or polygons of a mesh in Object Mode."""
    if extend:
        chosen = chosen | read_flags(elements, "select")
    mesh = elements.id_data
    attributes, active = mesh.attributes, mesh.attributes.active
    name = None if active is None else active.name
    flags = attributes.get(".select_edge")
    if elements == mesh.edges and flags is not None:
        # Blender 5.0 crashes if it writes to those that it loaded from a file.
        attributes.remove(flags)
    write_flags(elements, "select", chosen)
    if name is not None:
        attributes.active = attributes[name]  # removing one makes another active


def _select_in_edit_mode(
    mesh: bpy.types.Mesh, domain: str, chosen: BoolArray, extend: bool
) -> None:
    """Select edges or faces of a mesh in Edit Mode; hidden ones stay unselected."""
    bm = bmesh.from_edit_mesh(mesh)
    if not extend:
        for element in (*bm.faces, *bm.edges, *bm.verts):
            element.select_set(False)
    for element, select in zip(getattr(bm, domain), chosen.tolist(), strict=True):
        if select and not element.hide:
            element.select_set(True)
    bm.select_flush_mode()
    show_flags(mesh)


def show_flags(mesh: bpy.types.Mesh) -> None:
    """Tell Blender that flags have changed."""
    if mesh.is_editmode:
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    else:
        mesh.update()
