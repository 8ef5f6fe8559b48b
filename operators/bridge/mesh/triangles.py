"""How faces are cut into triangles.

Blender tells the corners of triangles one by one, which takes 0.1 s for a million, and
its choice between the two ways to cut a quad depends on whether it knows the normals of
faces. So it is asked only for faces with more corners.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import bpy
import numpy as np

from ....core.geometry.cutting.triangulation import are_folded
from ....core.steps.arrays import Float32Array, Int32Array, IntArray
from ....core.steps.progress import Progress, Steps
from .attributes import read_ints

# Faces that are looked at together: their arrays fit into the cache.
_BLOCK = 2**14
# To ask for single triangles is quicker, if they are at most this share of all.
_FEW = 0.05


class Asked(NamedTuple):
    """What Blender was asked of a mesh; how it cuts the other faces follows from it.

    Attributes
    ----------
    counts : (P,) int
        Number of triangles of each face.
    rows : (R,) int
        Triangles of the faces with more than four corners.
    corners : (R, 3) int32
        Their corners.
    """

    counts: IntArray
    rows: IntArray
    corners: Int32Array


def ask(mesh: bpy.types.Mesh, faces: Int32Array) -> Asked:
    """Ask Blender for the triangles of faces with more than four corners.

    Parameters
    ----------
    mesh : bpy.types.Mesh
        With its triangles made.
    faces : (T,) int32
        The face of each triangle.
    """
    counts = np.bincount(faces, minlength=len(mesh.polygons))
    large = counts > 2
    rows = np.flatnonzero(large[faces] if large.any() else large[:0])
    triangles = mesh.loop_triangles
    if len(rows) > _FEW * len(faces):
        return Asked(counts, rows, read_ints(triangles, "loops", 3)[rows])
    told = [triangles[row].loops[:] for row in rows.tolist()]
    return Asked(counts, rows, np.array(told, dtype=np.int32).reshape(-1, 3))


def cut_in_steps(
    asked: Asked, places: Float32Array, corners: Int32Array
) -> Steps[IntArray]:
    """Cut all faces of a mesh into triangles.

    A quad is cut between its first and third corner, unless the other two lie on the
    same side of that line.

    Parameters
    ----------
    asked : Asked
    places : (V, 3) float32
        The vertices.
    corners : (C,) int32
        The vertex of each corner.

    Returns
    -------
    Steps of (T, 3) int
        The vertices of each triangle.
    """
    found = np.empty((int(asked.counts.sum()), 3), dtype=np.int64)
    done = 0
    for counts, firsts in _blocks_of_faces(asked.counts):
        yield Progress("Surface", 0.0)
        starts = np.cumsum(counts) - counts
        cut = np.arange(counts.sum())[:, None] + (0, 1, 2)
        cut += np.repeat(firsts - starts, counts)[:, None]
        cut[:, 0] = np.repeat(firsts, counts)
        quads = np.flatnonzero(counts == 2)
        around = corners[firsts[quads] + np.arange(4)[:, None]]
        turned = starts[quads[are_folded(places[around].astype(float))]]
        cut[turned, 2] += 1
        cut[turned + 1, 0] += 1
        found[done : done + len(cut)] = corners[cut]
        done += len(cut)
    found[asked.rows] = corners[asked.corners]
    return found


def _blocks_of_faces(counts: IntArray) -> Iterator[tuple[IntArray, IntArray]]:
    """Yield the numbers of triangles of some faces at a time, and their first corners.

    Together, all faces of a large mesh would take much memory.
    """
    first = 0
    for start in range(0, len(counts), _BLOCK):
        block = counts[start : start + _BLOCK]
        ends = first + np.cumsum(block + 2)
        yield block, ends - block - 2
        first = ends[-1]
