"""Faces and edges of parts selected, hidden or marked, in Object and in Edit Mode.

In Edit Mode the mesh is a BMesh; in Object Mode the mesh keeps flags that Edit Mode
begins with.
"""

from __future__ import annotations

from collections.abc import Sequence

import bmesh
import bpy
import numpy as np
from numpy.typing import NDArray

from .layers import IntArray

BoolArray = NDArray[np.bool_]


def select_faces(obj: bpy.types.Object, faces: BoolArray, extend: bool) -> None:
    """Select faces, and nothing else unless `extend`."""
    mesh = obj.data
    corners, edges, sizes = _corners(mesh)
    of_faces = np.repeat(faces, sizes)
    for domain, chosen in (
        ("vertices", _flags(len(mesh.vertices), corners[of_faces])),
        ("edges", _flags(len(mesh.edges), edges[of_faces])),
        ("polygons", faces),
    ):
        _select(obj, domain, chosen, extend)
    _finish(obj)


def select_edges(obj: bpy.types.Object, chosen: BoolArray, extend: bool) -> None:
    """Select edges, and nothing else unless `extend`."""
    mesh = obj.data
    ends = np.empty(len(mesh.edges) * 2, dtype=np.int32)
    mesh.edges.foreach_get("vertices", ends)
    touched = _flags(len(mesh.vertices), ends.reshape(-1, 2)[chosen].ravel())
    for domain, flags in (
        ("vertices", touched),
        ("edges", chosen),
        ("polygons", np.zeros(len(mesh.polygons), dtype=bool)),
    ):
        _select(obj, domain, flags, extend)
    _finish(obj)


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
    _finish(obj)


def hide_faces(obj: bpy.types.Object, hidden: BoolArray) -> None:
    """Hide these faces of a mesh that is edited, and show all others."""
    bm = bmesh.from_edit_mesh(obj.data)
    for element in (*bm.verts, *bm.edges, *bm.faces):
        element.hide_set(False)
    for face, hide in zip(bm.faces, hidden.tolist(), strict=True):
        if hide:
            face.hide_set(True)
    _finish(obj)


def boundary_edges(
    obj: bpy.types.Object, labels: IntArray, chosen: Sequence[int]
) -> BoolArray:
    """Return which edges lie between chosen parts and other parts, (E,)."""
    mesh = obj.data
    _, edges, sizes = _corners(mesh)
    labels = np.repeat(labels, sizes)
    lowest = np.full(len(mesh.edges), np.iinfo(labels.dtype).max)
    highest = np.full(len(mesh.edges), -1, dtype=labels.dtype)
    np.minimum.at(lowest, edges, labels)
    np.maximum.at(highest, edges, labels)
    between = (highest >= 0) & (lowest != highest)
    of_chosen = np.zeros(len(mesh.edges), dtype=bool)
    of_chosen[edges[np.isin(labels, chosen)]] = True
    return between & of_chosen


def _corners(mesh: bpy.types.Mesh) -> tuple[IntArray, IntArray, IntArray]:
    """Return the vertex and the edge of each corner, and the corners of each face."""
    vertices = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", vertices)
    edges = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("edge_index", edges)
    sizes = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("loop_total", sizes)
    return vertices, edges, sizes


def _flags(size: int, rows: IntArray) -> BoolArray:
    flags = np.zeros(size, dtype=bool)
    flags[rows] = True
    return flags


def _select(
    obj: bpy.types.Object, domain: str, chosen: BoolArray, extend: bool
) -> None:
    """Select vertices, edges or polygons."""
    mesh = obj.data
    if not mesh.is_editmode:
        elements = getattr(mesh, domain)
        if extend:
            before = np.empty(len(elements), dtype=bool)
            elements.foreach_get("select", before)
            chosen = chosen | before
        elements.foreach_set("select", chosen)
        return
    bm = bmesh.from_edit_mesh(mesh)
    elements = {"vertices": bm.verts, "edges": bm.edges, "polygons": bm.faces}[domain]
    for element, select in zip(elements, chosen.tolist(), strict=True):
        if not element.hide:
            element.select = select or (extend and element.select)


def _finish(obj: bpy.types.Object) -> None:
    """Tell Blender that flags have changed."""
    mesh = obj.data
    if not mesh.is_editmode:
        mesh.update()
        return
    bmesh.from_edit_mesh(mesh).select_flush_mode()
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
