"""Finds the knees of limbs: where the line through their middle turns at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...geometry.frames import unit
from .surface import PartSurface

# A limb is so long: its squared length is at least its area. A cylinder is, if it is
# six times as long as its radius. Lengths below are in such mean radii.
_LONG = 1.0
# The line through the middle has a point for each slice of this length, if slices have
# so many nodes; otherwise slices are longer, up to the second length.
_SLICE, _MOST_SLICE = 0.5, 1.0
_NODES_OF_SLICE = 8
# How far from a knee its two directions are told, so that a knee differs from an arc.
_FROM, _TO = 0.5, 3.0
# Least turn at a knee, in radians.
LEAST_TURN = 0.7
# Least distance of a knee from another one and from the ends of the limb.
_APART = 2.5


class Knees(NamedTuple):
    """The knees of one limb.

    Attributes
    ----------
    pieces : (M,) int
        Number of the piece between two knees that each node lies on, from the seams on.
    turns : list of float
        How much the limb turns between a piece and the next one, in radians.
    """

    pieces: NDArray[np.int64]
    turns: list[float]


def find_knees(part: PartSurface) -> Knees:
    """Return the knees of a part; none if it is no limb.

    Parameters
    ----------
    part : PartSurface

    Returns
    -------
    Knees
    """
    none = Knees(np.zeros(len(part.kept), dtype=np.int64), [])
    area = float(part.graph.areas.sum())
    if part.far.max() ** 2 < _LONG * area:
        return none
    far = part.from_node(int(part.far.argmax()))
    if (far == 0).sum() > 1:
        return none  # a part of several shells
    length = float(far.max())
    radius = area / (2 * np.pi * length)
    n_slices = _number_of_slices(len(far), length / radius)
    if n_slices == 0:
        return none
    at, line = _middle(part, far, n_slices)
    n_places = int(4 * (length / radius - 2 * _APART))
    places = np.linspace(_APART * radius, length - _APART * radius, n_places)
    turns = _turns(at, line, places, radius)
    chosen = _peaks(places, turns, _APART * radius)
    pieces = len(chosen) - np.searchsorted(places[chosen], far)
    return Knees(pieces.astype(np.int64), turns[chosen[::-1]].tolist())


def _number_of_slices(n_nodes: int, length: float) -> int:
    """Return into how many slices a limb is cut, 0 if it is too coarse for it."""
    most = min(length / _SLICE, n_nodes / _NODES_OF_SLICE)
    return int(most) if most >= length / _MOST_SLICE else 0


def _middle(
    part: PartSurface, far: NDArray[np.float64], n_slices: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the distance from the tip and the center of each slice."""
    graph, width = part.graph, far.max() / n_slices
    rows = np.minimum((far / width).astype(np.int64), n_slices - 1)
    areas = np.bincount(rows, graph.areas, n_slices)
    columns = (graph.areas[:, None] * graph.centers).T
    sums = np.stack([np.bincount(rows, column, n_slices) for column in columns], axis=1)
    full = areas > 0
    at = (np.flatnonzero(full) + 0.5) * width
    return at, sums[full] / areas[full][:, None]


def _turns(
    at: NDArray[np.float64],
    line: NDArray[np.float64],
    places: NDArray[np.float64],
    radius: float,
) -> NDArray[np.float64]:
    """Return the angle between the directions before and after each place."""

    def along(where: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.stack([np.interp(where, at, column) for column in line.T], axis=1)

    before = along(places - _FROM * radius) - along(places - _TO * radius)
    after = along(places + _TO * radius) - along(places + _FROM * radius)
    cosines = (unit(before) * unit(after)).sum(axis=1)
    return np.arccos(np.clip(cosines, -1.0, 1.0))


def _peaks(
    places: NDArray[np.float64], turns: NDArray[np.float64], apart: float
) -> NDArray[np.int64]:
    """Return the places of the largest turns that are so far apart, ascending."""
    chosen: list[int] = []
    for place in np.argsort(-turns, kind="stable").tolist():
        if turns[place] < LEAST_TURN:
            break
        if all(abs(places[place] - places[other]) >= apart for other in chosen):
            chosen.append(place)
    return np.array(sorted(chosen), dtype=np.int64)
