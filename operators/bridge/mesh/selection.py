"""Faces and edges of parts selected, hidden or marked, in Object and in Edit Mode.

In Edit Mode the mesh is a BMesh; in Object Mode the mesh keeps flags that Edit Mode
begins with.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bmesh
import bpy
import numpy as np
from numpy.typing import NDArray

from .corners import IntArray, corner_edges, corner_faces, corner_vertices

BoolArray = NDArray[np.bool_]


def select_faces(obj: bpy.types.Object, chosen: BoolArray, extend: bool) -> None:
    """Select faces, and nothing else unless `extend`."""
    mesh = obj.data
    if mesh.is_editmode:
        _select_in_edit_mode(mesh, "faces", chosen, extend)
        return
    of_faces = chosen[corner_faces(mesh)]
    vertices, edges = corner_vertices(mesh)[of_faces], corner_edges(mesh)[of_faces]
    _select(mesh.vertices, _flags(len(mesh.vertices), vertices), extend)
    _select(mesh.edges, _flags(len(mesh.edges), edges), extend)
    _select(mesh.polygons, chosen, extend)
    _show(mesh)


def select_edges(obj: bpy.types.Object, chosen: BoolArray, extend: bool) -> None:
    """Select edges, and nothing else unless `extend`; they show where faces do, too."""
    mesh = obj.data
    settings = bpy.context.scene.tool_settings
    if settings.mesh_select_mode[:] == (False, False, True):
        settings.mesh_select_mode = (False, True, False)
    if mesh.is_editmode:
        _select_in_edit_mode(mesh, "edges", chosen, extend)
        return
    ends = np.empty(len(mesh.edges) * 2, dtype=np.int32)
    mesh.edges.foreach_get("vertices", ends)
    touched = ends.reshape(-1, 2)[chosen].ravel()
    _select(mesh.vertices, _flags(len(mesh.vertices), touched), extend)
    _select(mesh.edges, chosen, extend)
    _select(mesh.polygons, np.zeros(len(mesh.polygons), dtype=bool), extend)
    _show(mesh)


def mark_seams(obj: bpy.types.Object, chosen: BoolArray) -> None:
    """Mark edges as seams, for unwrapping; other seams stay."""
    mesh = obj.data
    if not mesh.is_editmode:
        seams = np.empty(len(mesh.edges), dtype=bool)
        mesh.edges.foreach_get("use_seam", seams)
        mesh.edges.foreach_set("use_seam", seams | chosen)
    else:
        edges = bmesh.from_edit_mesh(mesh).edges
        edges.ensure_lookup_table()
        for index in np.flatnonzero(chosen).tolist():
            edges[index].seam = True
    _show(mesh)


def hide_faces(obj: bpy.types.Object, hidden: BoolArray) -> None:
    """Hide these faces of a mesh that is edited, and show all others."""
    bm = bmesh.from_edit_mesh(obj.data)
    for element in (*bm.verts, *bm.edges, *bm.faces):
        element.hide_set(False)
    for face, hide in zip(bm.faces, hidden.tolist(), strict=True):
        if hide:
            face.hide_set(True)
    _show(obj.data)


def boundary_edges(
    obj: bpy.types.Object, labels: IntArray, chosen: Sequence[int]
) -> BoolArray:
    """Return which edges lie between chosen parts and other parts, (E,)."""
    mesh = obj.data
    edges, labels = corner_edges(mesh), labels[corner_faces(mesh)]
    lowest = np.full(len(mesh.edges), np.iinfo(labels.dtype).max)
    highest = np.full(len(mesh.edges), -1, dtype=labels.dtype)
    np.minimum.at(lowest, edges, labels)
    np.maximum.at(highest, edges, labels)
    between = (highest >= 0) & (lowest != highest)
    of_chosen = np.zeros(len(mesh.edges), dtype=bool)
    of_chosen[edges[np.isin(labels, chosen)]] = True
    return between & of_chosen


def _flags(size: int, rows: IntArray) -> BoolArray:
    flags = np.zeros(size, dtype=bool)
    flags[rows] = True
    return flags


def _select(elements: Any, chosen: BoolArray, extend: bool) -> None:
    """Select vertices, edges or polygons of a mesh that is not edited."""
    if extend:
        before = np.empty(len(elements), dtype=bool)
        elements.foreach_get("select", before)
        chosen = chosen | before
    elements.foreach_set("select", chosen)


def _select_in_edit_mode(
    mesh: bpy.types.Mesh, domain: str, chosen: BoolArray, extend: bool
) -> None:
    """Select edges or faces of a mesh that is edited, but for hidden ones."""
    bm = bmesh.from_edit_mesh(mesh)
    if not extend:
        for element in (*bm.faces, *bm.edges, *bm.verts):
            element.select_set(False)
    for element, select in zip(getattr(bm, domain), chosen.tolist(), strict=True):
        if select and not element.hide:
            element.select_set(True)
    bm.select_flush_mode()
    _show(mesh)


def _show(mesh: bpy.types.Mesh) -> None:
    """Tell Blender that flags have changed."""
    if mesh.is_editmode:
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    else:
        mesh.update()
