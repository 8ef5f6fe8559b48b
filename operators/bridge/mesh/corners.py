"""The corners of the faces of a mesh, which Blender calls loops.

A face has one corner for each of its vertices. The corners of face 0 come first, then
the corners of face 1, and so on.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ....core.steps.arrays import BoolArray
from .attributes import corner_edges
from .known import corner_faces


def edge_sides(
    mesh: bpy.types.Mesh, labels: NDArray[np.integer[Any]]
) -> tuple[NDArray[np.integer[Any]], NDArray[np.integer[Any]]]:
    """Return the lowest and the highest label of the faces at each edge.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    labels : (P,) int
        Label of each face, 0 or more.

    Returns
    -------
    lowest, highest : (E,) int
        `highest` is -1 for edges without faces.
    """
    edges, of_corners = corner_edges(mesh), labels[corner_faces(mesh)]
    lowest = np.full(len(mesh.edges), np.iinfo(labels.dtype).max, dtype=labels.dtype)
    highest = np.full(len(mesh.edges), -1, dtype=labels.dtype)
    np.minimum.at(lowest, edges, of_corners)
    np.maximum.at(highest, edges, of_corners)
    return lowest, highest


def boundary_edges(
    mesh: bpy.types.Mesh, labels: NDArray[np.integer[Any]], chosen: Sequence[int]
) -> BoolArray:
    """Return which edges lie between a chosen part and another part.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    labels : (P,) int
        Part of each face.
    chosen : sequence of int
        Parts.

    Returns
    -------
    (E,) bool
    """
    lowest, highest = edge_sides(mesh, labels)
    of_chosen = np.zeros(len(mesh.edges), dtype=bool)
    corners = np.isin(labels[corner_faces(mesh)], chosen)
    of_chosen[corner_edges(mesh)[corners]] = True
    return (highest >= 0) & (lowest != highest) & of_chosen
