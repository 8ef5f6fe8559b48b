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

# So many triangles are compared each with each; no box is halved more often.
_FEW = 96
_MOST_HALVINGS = 24
# A box is not halved if its halves have so many times its triangles together.
_NO_FEWER = 1.6
# Pairs that are compared at once, and in all.
_AT_ONCE = 2**15
_MOST_PAIRS = 2**28
# Products of matrices are as exact as this on all processors.
_SLACK = 1e-9


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
        None where so many triangles are near one another that it would take long, as
        where large surfaces lie on each other.
    """
    search = _Search(mesh, shells)
    pairs = yield from search.pairs()
    found = [_crossed(pairs[:0], search.corners, mesh.normals)]
    for rows in blocks(len(pairs)):
        yield Progress("Seams", 0.0)
        found.append(_crossed(pairs[rows], search.corners, mesh.normals))
    return Crossings(*(np.concatenate(values) for values in zip(*found, strict=True)))


class _Box(NamedTuple):
    """A box of space and the triangles, (N,), whose own boxes reach into it."""

    rows: IntArray
    low: FloatArray
    high: FloatArray
    depth: int


class _Search:
    """Finds pairs of triangles that may cross, in boxes that are halved."""

    def __init__(self, mesh: TriangleMesh, shells: IntArray) -> None:
        self._mesh, self._shells = mesh, shells
        self.corners = np.empty((len(shells), 3, 3))
        self._lows, self._highs = np.empty((2, len(shells), 3))

    def pairs(self) -> Steps[IntArray]:
        """Return pairs (N, 2) of triangles of two shells that may cross."""
        for some in blocks(len(self._shells)):
            yield Progress("Seams", 0.0)
            corners = self._mesh.vertices[self._mesh.triangles[some]]
            self.corners[some] = corners
            # Faces that touch cross if they are moved outwards a little.
            self._lows[some] = corners.min(axis=1) - GAP
            self._highs[some] = corners.max(axis=1) + GAP
        rows = np.flatnonzero(self._shells >= 0)
        found, compared = [np.zeros((0, 2), dtype=np.int64)], 0
        low, high = self._lows.min(axis=0) - 1, self._highs.max(axis=0) + 1
        boxes = [_Box(rows, low, high, 0)]
        while boxes:
            yield Progress("Seams", 0.0)
            box = boxes.pop()
            if (self._shells[box.rows] == self._shells[box.rows[:1]]).all():
                continue
            if len(box.rows) > _FEW and box.depth < _MOST_HALVINGS:
                halves = self._halves(box)
                if sum(len(half.rows) for half in halves) < _NO_FEWER * len(box.rows):
                    boxes += halves
                    continue
            compared += len(box.rows) ** 2
            if compared > _MOST_PAIRS:
                return found[0]
            for some in blocks(len(box.rows), _AT_ONCE // len(box.rows)):
                yield Progress("Seams", 0.0)
                found.append(self._near(box, box.rows[some]))
        return np.concatenate(found)

    def _halves(self, box: _Box) -> list[_Box]:
        """Return the two halves of a box, across its longest side."""
        axis = int((box.high - box.low).argmax())
        below, above = box.high.copy(), box.low.copy()
        below[axis] = above[axis] = middle = (box.low[axis] + box.high[axis]) / 2
        first = box.rows[self._lows[box.rows, axis] <= middle]
        second = box.rows[self._highs[box.rows, axis] > middle]
        return [
            _Box(first, box.low, below, box.depth + 1),
            _Box(second, above, box.high, box.depth + 1),
        ]

    def _near(self, box: _Box, some: IntArray) -> IntArray:
        """Return pairs (N, 2) of `some` rows and all of a box.

        A pair is of the box in which the lowest corner of what both boxes share is.
        """
        rows = box.rows
        near = self._shells[some, None] < self._shells[rows]
        for axis in range(3):
            near &= self._lows[some, None, axis] <= self._highs[rows, axis]
            near &= self._highs[some, None, axis] >= self._lows[rows, axis]
        near &= self._reaches(some, rows)
        near &= self._reaches(rows, some).T
        one, other = np.nonzero(near)
        pairs = np.stack([some[one], rows[other]], axis=1)
        lowest = self._lows[pairs].max(axis=1)
        mine = ((lowest > box.low) & (lowest <= box.high)).all(axis=1)
        return pairs[mine]

    def _reaches(self, one: IntArray, other: IntArray) -> BoolArray:
        """Return whether triangles have corners on both sides of others, (N, M)."""
        normals = self._mesh.normals[other]
        levels = (normals * self.corners[other, 0]).sum(axis=1) + GAP
        heights = [self.corners[one, i] @ normals.T - levels for i in range(3)]
        highest = np.maximum(np.maximum(heights[0], heights[1]), heights[2])
        lowest = np.minimum(np.minimum(heights[0], heights[1]), heights[2])
        return (highest > -_SLACK) & (lowest < _SLACK)


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
