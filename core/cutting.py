"""Planes through a shape: triangles in two, and cross-sections."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .axes import frames
from .solid import Solid

# Distance of points in a cross-section; the longest side of a shape is 2.
_GRAIN = 0.04


def cut_triangles(
    corners: NDArray[np.float64], plane: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Cut triangles by a plane.

    Parameters
    ----------
    corners : (T, 3, 3) float
    plane : (4,) float
        n · x + d ≤ 0 below it.

    Returns
    -------
    below, above : (B, 3, 3), (A, 3, 3) float
        Triangles on both sides, those that the plane meets in pieces.
    segments : (S, 2, 3) float
        Where it meets them, the inside on the left as seen along the normal.
    """
    heights = corners @ plane[:3] + plane[3]
    under = heights <= 0
    n_under = under.sum(axis=1)
    met = (n_under > 0) & (n_under < 3)
    # Each is turned so that the corner alone on its side comes first.
    lone_under = n_under[met] == 1
    alone = np.where(lone_under[:, None], under[met], ~under[met])
    turn = (alone.argmax(axis=1)[:, None] + np.arange(3)) % 3
    a, b, c = np.moveaxis(np.take_along_axis(corners[met], turn[..., None], 1), 1, 0)
    over = np.take_along_axis(heights[met], turn, axis=1)[..., None]
    ab = a + over[:, 0] / (over[:, 0] - over[:, 1]) * (b - a)
    ac = a + over[:, 0] / (over[:, 0] - over[:, 2]) * (c - a)
    tips = np.stack([a, ab, ac], axis=1)
    rests = np.stack([np.stack([ab, b, c], 1), np.stack([ab, c, ac], 1)])
    below = [corners[n_under == 3], tips[lone_under], *rests[:, ~lone_under]]
    above = [corners[n_under == 0], tips[~lone_under], *rests[:, lone_under]]
    ends = np.stack([ab, ac], axis=1)
    segments = np.where(lone_under[:, None, None], ends[:, ::-1], ends)
    return np.concatenate(below), np.concatenate(above), segments


@dataclass(frozen=True, eq=False)
class Section:
    """Where a plane cuts the inside of a shape.

    Attributes
    ----------
    plane : (4,) float
    axes : (2, 3) float
        Of the plane.
    segments : (S, 2, 2) float
        Contour, along `axes`.
    """

    plane: NDArray[np.float64]
    axes: NDArray[np.float64]
    segments: NDArray[np.float64]

    def spread(self, within: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points spread evenly in the box around points (P, 3), (M, 3)."""
        flat = within @ self.axes.T
        steps = [
            np.arange(low + 0.39 * _GRAIN, high, _GRAIN)
            for low, high in zip(flat.min(axis=0), flat.max(axis=0), strict=True)
        ]
        columns, rows = np.nonzero(_is_inside(self.segments, *steps).T)
        spots = np.stack([steps[0][columns], steps[1][rows]], axis=1)
        return spots @ self.axes - self.plane[3] * self.plane[:3]

    def holds(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return which points (M, 3) of the plane are inside, (M,)."""
        across, up = (points @ self.axes.T).T[..., None]
        (x0, y0), (x1, y1) = self.segments.transpose(1, 2, 0)
        turns = (y1 > up).astype(np.int64) - (y0 > up)
        rise = np.where(y1 == y0, 1.0, y1 - y0)
        before = x0 + (up - y0) / rise * (x1 - x0) <= across
        windings = (turns * before).sum(axis=1)
        inside: NDArray[np.bool_] = (windings != 0) & (turns.sum(axis=1) == 0)
        return inside


def cross_section(solid: Solid, plane: NDArray[np.float64]) -> Section:
    """Return where a plane (4,) cuts the inside of a solid."""
    axes = np.concatenate(frames(plane[None, :3]))
    return Section(plane, axes, cut_triangles(solid.corners, plane)[2] @ axes.T)


def _is_inside(
    segments: NDArray[np.float64], across: NDArray[np.float64], up: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return which points of a grid are in a contour of segments (S, 2, 2), (U, A)."""
    (x0, y0), (x1, y1) = segments.transpose(1, 2, 0)
    turns = (y1 > up[:, None]).astype(np.int64) - (y0 > up[:, None])
    rows, crossed = np.nonzero(turns)
    share = (up[rows] - y0[crossed]) / (y1 - y0)[crossed]
    columns = np.searchsorted(across, x0[crossed] + share * (x1 - x0)[crossed])
    windings = np.zeros((len(up), len(across) + 1), dtype=np.int64)
    np.add.at(windings, (rows, columns), turns[rows, crossed])
    windings = np.cumsum(windings, axis=1)
    # A row across an open contour does not come back to 0: nothing tells its inside.
    return (windings[:, :-1] != 0) & (windings[:, -1:] == 0)
