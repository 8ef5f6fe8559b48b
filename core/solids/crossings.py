"""Where the surfaces of shells cross: a crease that has no edge of the mesh."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..geometry.frames import cross, unit
from ..geometry.mesh import TriangleMesh
from ..steps.arrays import BoolArray, FloatArray, IntArray
from ..steps.progress import Progress, Steps
from ..steps.rows import blocks
from .shells import GAP

# So many triangles are compared each with each, and no box is halved more often.
_FEW = 96
_MOST_HALVINGS = 24
# Pairs that are compared at once.
_MOST_PAIRS = 2**18


class Crossings(NamedTuple):
    """Short lines in which triangles of two shells cross.

    Attributes
    ----------
    pairs : (X, 2) int
        The triangles.
    lengths, bends : (X,) float
        Length of each line, and the concave angle there, in radians.
    """

    pairs: IntArray
    lengths: FloatArray
    bends: FloatArray


def find_crossings(mesh: TriangleMesh, shells: IntArray) -> Steps[Crossings]:
    """Return where triangles of two shells cross or touch.

    Parameters
    ----------
    mesh : TriangleMesh
        Its diagonal is 1.
    shells : (T,) int
        Shell of each triangle; those of −1 are left out.

    Returns
    -------
    Steps of Crossings
    """
    corners = mesh.vertices[mesh.triangles]
    # Faces that touch cross if they are moved outwards a little.
    lows, highs = corners.min(axis=1) - GAP, corners.max(axis=1) + GAP
    found = [np.zeros((0, 2), dtype=np.int64)]
    boxes = [(np.flatnonzero(shells >= 0), lows.min(axis=0), highs.max(axis=0), 0)]
    while boxes:
        yield Progress("Seams", 0.0)
        rows, low, high, depth = boxes.pop()
        if len(rows) == 0 or (shells[rows] == shells[rows[0]]).all():
            continue
        if len(rows) <= _FEW or depth == _MOST_HALVINGS:
            found += _near(lows[rows], highs[rows], shells[rows], rows)
            continue
        axis = int((high - low).argmax())
        middle = (low[axis] + high[axis]) / 2
        below, above = high.copy(), low.copy()
        below[axis] = above[axis] = middle
        boxes.append((rows[lows[rows, axis] <= middle], low, below, depth + 1))
        boxes.append((rows[highs[rows, axis] >= middle], above, high, depth + 1))
    pairs = np.unique(np.concatenate(found), axis=0)
    return _crossed(pairs, corners, mesh.normals)


def _near(
    lows: FloatArray, highs: FloatArray, shells: IntArray, rows: IntArray
) -> list[IntArray]:
    """Return pairs (N, 2) of `rows` of two shells whose boxes overlap."""
    found = []
    for some in blocks(len(rows), _MOST_PAIRS // len(rows)):
        near = shells[some, None] < shells
        for axis in range(3):
            near &= lows[some, None, axis] <= highs[:, axis]
            near &= highs[some, None, axis] >= lows[:, axis]
        one, other = np.nonzero(near)
        found.append(np.stack([rows[some][one], rows[other]], axis=1))
    return found


def _crossed(pairs: IntArray, corners: FloatArray, normals: FloatArray) -> Crossings:
    """Return those of some pairs of triangles that cross, and in which lines."""
    one, other = pairs.T
    heights = _heights(corners[one], corners[other], normals[other])
    others = _heights(corners[other], corners[one], normals[one])
    kept = _crosses(heights) & _crosses(others)
    pairs, heights, others = pairs[kept], heights[kept], others[kept]
    one, other = pairs.T
    along = cross(normals[one], normals[other])
    bends = np.arctan2(
        np.linalg.norm(along, axis=1), (normals[one] * normals[other]).sum(axis=1)
    )
    along = unit(along)[:, None]
    start, end = _span((corners[one] * along).sum(axis=2), heights)
    since, until = _span((corners[other] * along).sum(axis=2), others)
    lengths = np.minimum(end, until) - np.maximum(start, since)
    kept = lengths > 0
    return Crossings(pairs[kept], lengths[kept], bends[kept])


def _heights(
    corners: FloatArray, others: FloatArray, normals: FloatArray
) -> FloatArray:
    """Return the heights of corners (N, 3, 3) above other triangles, (N, 3)."""
    return ((corners - others[:, :1]) * normals[:, None]).sum(axis=2) - GAP


def _crosses(heights: FloatArray) -> BoolArray:
    """Return whether triangles have corners on both sides, (N,)."""
    crosses: BoolArray = (heights.max(axis=1) > 0) & (heights.min(axis=1) < 0)
    return crosses


def _span(places: FloatArray, heights: FloatArray) -> FloatArray:
    """Return from where to where triangles cross a plane, (2, N).

    `places` (N, 3) are those of the corners along the line of both planes.
    """
    above = heights > 0
    # The corner that is alone on its side; the line crosses the two sides there.
    alone = (above == (above.sum(axis=1) == 1)[:, None]).argmax(axis=1)
    turned = (alone[:, None] + np.arange(3)) % 3
    place, height = (np.take_along_axis(a, turned, axis=1).T for a in (places, heights))
    ends = place[0] + (place[1:] - place[0]) * height[0] / (height[0] - height[1:])
    return np.sort(ends, axis=0)
