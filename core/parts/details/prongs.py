"""Finds the prongs of parts, such as the fingers of an arm, from the surface alone.

Few samples of a whole shape lie on a finger, so that psi does not find it. But an arm
without fingers has one tip, and an arm with fingers has five: places that are farther
from the rest of the shape than all around them. To see them takes no ray.
"""

from __future__ import annotations

import numpy as np

from ...geometry.graphs.components import nodes_at_seams
from ...geometry.graphs.face_graph import FaceGraph
from ...steps.arrays import BoolArray, IntArray
from ...steps.progress import Progress, Steps
from .surface import PartSurface, meetings

# A prong is long if its squared length is at least this share of its area. A cylinder
# has that share if it is 2.5 times as long as its radius; a heel has less.
_LONG = 0.4
# Least length of a prong, as a share of the largest distance from the part's seams, and
# number of its nodes: smaller ones are roughness.
_LEAST_LENGTH = 0.03
_LEAST_NODES = 6


def find_tips(graph: FaceGraph, parts: IntArray, chosen: BoolArray) -> Steps[IntArray]:
    """Return the tips of the prongs of some parts.

    Seen from the tips, distances from the part's seams fall until two prongs meet. The
    shorter one ends there, and so has a length and an area. If it is long, both count.
    A part without seams has no prongs.

    Parameters
    ----------
    graph : FaceGraph
    parts : (P,) int
        Part of each node, in 0…K − 1.
    chosen : (K,) bool
        Parts to look at.

    Returns
    -------
    Steps of (T,) int
        Different nodes, ascending; at least two of each part that has prongs.
    """
    at_seams = nodes_at_seams(graph.neighbors, parts)
    found = [np.zeros(0, dtype=np.int64)]
    for part in np.flatnonzero(chosen).tolist():
        yield Progress("Details", 0.0)
        surface = PartSurface(graph, np.flatnonzero(parts == part), at_seams)
        found.append(surface.kept[_long_prongs(surface)])
    return np.sort(np.concatenate(found))


def _long_prongs(part: PartSurface) -> list[int]:
    """Return the tips of prongs of a part that are long where they meet another."""
    far, least, found = part.far, _LEAST_LENGTH * float(part.far.max()), set()
    for short, long, between, prong in meetings(far, part.graph.neighbors):
        length = far[short] - far[between]
        if length > least:
            beyond = np.flatnonzero(prong & (far > far[between]))
            is_long = length**2 >= _LONG * part.graph.areas[beyond].sum()
            if is_long and len(beyond) >= _LEAST_NODES:
                found |= {short, long}
    return list(found)
