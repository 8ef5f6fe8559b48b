"""What the surface of a limb tells: how long and thick it is, where its middle runs."""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...geometry.frames import unit
from ...geometry.labels import sums_by_label
from ...steps.arrays import FloatArray, IntArray
from .surface import PartSurface

# A limb is so long: its squared length is at least its area. A cylinder is, if it is
# six times as long as its radius. Lengths below are in such mean radii.
_LONG = 1.0
# The line through the middle has a point for each slice of this length, if slices have
# so many nodes; otherwise slices are longer, up to the second length.
_SLICE, _MOST_SLICE = 0.5, 1.0
_NODES_OF_SLICE = 8


class Joints(NamedTuple):
    """Where one limb may come apart.

    Attributes
    ----------
    pieces : (M,) int
        Number of the piece between two joints that each node lies on, from the seams
        on.
    sizes : list of float
        How clear the joint between a piece and the next one is: how much the limb
        turns, in radians, or how many times as thick it is on both sides.
    """

    pieces: IntArray
    sizes: list[float]


class Limb:
    """A long thin part.

    Parameters
    ----------
    part : PartSurface
    far : (M,) float
        Distance of each node from the tip.

    Attributes
    ----------
    part : PartSurface
    far : (M,) float
    length : float
    radius : float
        That of a cylinder of this length and area.
    is_fine : bool
        Whether slices are short enough to tell where the middle is.
    """

    def __init__(self, part: PartSurface, far: FloatArray) -> None:
        self.part, self.far, self.length = part, far, float(far.max())
        areas = part.graph.areas
        area = float(areas.sum())
        self.radius = area / (2 * np.pi * self.length)
        # So many of equal area tell as much: small ones beside large ones tell little.
        n_nodes = area**2 / float(np.square(areas).sum())
        most = min(self.length / self.radius / _SLICE, n_nodes / _NODES_OF_SLICE)
        self._n_slices = int(most)
        self.is_fine = most >= self.length / self.radius / _MOST_SLICE

    @cached_property
    def _middle(self) -> tuple[FloatArray, FloatArray]:
        """Distance from the tip and center of each slice."""
        graph, width = self.part.graph, self.length / self._n_slices
        rows = np.minimum((self.far / width).astype(np.int64), self._n_slices - 1)
        areas = np.bincount(rows, graph.areas, self._n_slices)
        moments = graph.areas[:, None] * graph.centers
        sums = sums_by_label(moments, rows, self._n_slices)
        full = areas > 0
        at = (np.flatnonzero(full) + 0.5) * width
        line = sums[full] / areas[full, None]
        return at.astype(np.float64), line

    def middle(self, at: FloatArray) -> FloatArray:
        """Return the points of the middle at distances (N,) from the tip, (N, 3)."""
        known, line = self._middle
        return np.stack([np.interp(at, known, column) for column in line.T], axis=1)

    def directions(self, first: FloatArray, last: FloatArray) -> FloatArray:
        """Return the unit directions between two such distances (N,), (N, 3)."""
        return unit(self.middle(last) - self.middle(first))

    def joints_at(
        self, places: FloatArray, sizes: FloatArray, least: float, apart: float
    ) -> Joints:
        """Return the joints at the places (N,) of the largest sizes (N,).

        Parameters
        ----------
        places : (N,) float
            Distances from the tip, ascending.
        sizes : (N,) float
        least : float
            Smaller sizes are no joints.
        apart : float
            Joints are at least so many radii from each other.
        """
        chosen: list[int] = []
        for place in np.argsort(-sizes, kind="stable").tolist():
            if sizes[place] < least:
                break
            ways = np.abs(places[chosen] - places[place])
            if (ways >= apart * self.radius).all():
                chosen.append(place)
        chosen.sort()
        pieces = len(chosen) - np.searchsorted(places[chosen], self.far)
        return Joints(pieces.astype(np.int64), sizes[chosen[::-1]].tolist())


def limb_of(part: PartSurface) -> Limb | None:
    """Return a part as a limb; None if it is none, or too coarse for it."""
    if part.far.max() ** 2 < _LONG * float(part.graph.areas.sum()):
        return None
    (far,) = part.from_nodes([int(part.far.argmax())])
    if (far == 0).sum() > 1:
        return None  # a part of several shells
    limb = Limb(part, far)
    return limb if limb.is_fine else None
