"""Corners of a mesh's faces: Blender's loops, one for each vertex of each face."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

IntArray = NDArray[np.int32]


def corner_vertices(mesh: bpy.types.Mesh) -> IntArray:
    """Return the vertex of each corner, (C,)."""
    return _read(mesh.loops, "vertex_index")


def corner_edges(mesh: bpy.types.Mesh) -> IntArray:
    """Return the edge from each corner to the next one of its face, (C,)."""
    return _read(mesh.loops, "edge_index")


def corner_faces(mesh: bpy.types.Mesh) -> IntArray:
    """Return the face of each corner, (C,)."""
    sizes = _read(mesh.polygons, "loop_total")
    return np.repeat(np.arange(len(sizes), dtype=np.int32), sizes)


def _read(elements: bpy.types.bpy_prop_collection, name: str) -> IntArray:
    values = np.empty(len(elements), dtype=np.int32)
    elements.foreach_get(name, values)
    return values
