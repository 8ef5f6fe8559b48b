"""Closes loops of creases across flat faces, where two blocks are flush.

The crease around the leg of a block figure ends where the leg's outer side is in one
plane with that of the body. The plane of the body's bottom shows where it would go on.
"""

from __future__ import annotations

import numpy as np

from ...geometry.graphs.face_graph import FaceGraph
from ...steps.arrays import BoolArray

# Neighbors are in one plane if the surface turns by less than this, in radians.
_FLAT = 1e-3
# So far from a plane, relative to the square root of the area, is on it; normals of
# faces on one plane differ by less than this.
_ON_PLANE = 1e-4
# Largest share of a loop that is not crease. Two flush sides of a square are too many.
_MOST_FLAT = 0.45
# So many planes are looked at, those of the faces beside the longest creases first, and
# none after one with a smaller share of all creases than this. Blocks have few planes,
# and the others are too many.
_MOST_PLANES = 32
_LEAST_CREASED = 0.01


def flush_seams(graph: FaceGraph, creases: BoolArray) -> BoolArray:
    """Return the edges within flat sides that close loops of creases.

    Parameters
    ----------
    graph : FaceGraph
    creases : (E,) bool
        Which shared edges are creases.

    Returns
    -------
    (E,) bool
        Those in the plane of a face beside a crease, if most of the seam in this
        plane is crease.
    """
    found = np.zeros(len(creases), dtype=bool)
    flat = np.flatnonzero(np.abs(graph.bends) < _FLAT)
    if len(flat) == 0 or not creases.any():
        return found
    ends = np.concatenate([graph.neighbors[flat], graph.neighbors[creases]])
    faces, ends = np.unique(ends, return_inverse=True)
    sides, rows = np.split(ends.reshape(-1, 2), [len(flat)])
    centers, normals = graph.centers[faces], graph.normals[faces]
    lengths = graph.lengths[creases]
    beside = np.bincount(rows.ravel(), np.repeat(lengths, 2), len(faces))
    near = _ON_PLANE * np.sqrt(graph.areas.sum())
    for _ in range(_MOST_PLANES):
        face = int(beside.argmax())
        if beside[face] == 0:
            break
        heights = (centers - centers[face]) @ normals[face]
        heights[np.abs(heights) <= near] = 0.0
        turned = np.abs(normals - normals[face]).max(axis=1) > _ON_PLANE
        on_plane = (heights == 0) & ~turned
        beside[on_plane] = 0.0
        creased = lengths[on_plane[rows].any(axis=1)].sum()
        if creased < _LEAST_CREASED * lengths.sum():
            break
        across = flat[heights[sides].prod(axis=1) < 0]
        gap = graph.lengths[across].sum()
        found[across] |= bool(gap <= _MOST_FLAT * (gap + creased))
    return found
