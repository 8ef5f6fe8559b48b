"""Pieces bounded by planes, which can be cut again."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...geometry.cutting.segments import segments_below
from ...geometry.frames import coordinates_along, heights_above, principal_axes
from ...steps.arrays import BoolArray, FloatArray
from ..convex_solid import exact_error
from ..fitting import Fit
from ..measure.error_bound import ErrorBound, ExactError
from ..piece import Piece
from ..solid import Solid
from .cross_section import cross_section, lines_of, meeting_points

# Planes and places this close to a face of a hull count as on it.
_AT_FACE = 1e-5


@dataclass(frozen=True, eq=False)
class Cell(Piece):
    """A piece bounded by planes, which can be cut again.

    Attributes
    ----------
    faces : (F, 3, 3) float
        Corners of the triangles that cuts through it meet.
    planes : (P, 4) float
        Unit normal n and offset d of each plane: n · x + d ≤ 0 in the piece.
    convex : bool, optional
        Whether it is surely convex, and all of it inside the solid.
    """

    faces: FloatArray
    planes: FloatArray
    convex: bool = False

    @cached_property
    def bound(self) -> ErrorBound | ExactError:
        """An upper bound of the error; of convex pieces mostly the error itself."""
        exact = exact_error(self.shape, self.hull, self.fit) if self.convex else None
        if exact is None:
            return super().bound
        return ExactError(exact, self.fit.max_error)

    @property
    def may_be_close(self) -> bool:
        """Whether the error may be allowed: where it is known, whether it is."""
        exact = self.convex and isinstance(self.bound, ExactError)
        return self.bound.is_allowed if exact else super().may_be_close

    @property
    def cut_share(self) -> float:
        """About the area of the faces that cuts made, over that of the solid."""
        return float(np.count_nonzero(~self.on_surface)) / len(self.solid.samples)

    @cached_property
    def uncut_depth(self) -> float:
        """About how deep its surface is below its hull, not below faces of cuts alone.

        In a thin slice of stairs, all of the surface is near such a face. But for hulls
        of the stairs, nothing is gained.
        """
        planes, places = self.hull.planes, self.boundary[self.on_surface]
        heights = heights_above(planes, places)
        bare = heights.max(axis=0, initial=-np.inf) < -_AT_FACE
        gaps = np.abs(planes[:, None] - self.planes).max(axis=2, initial=0.0)
        kept = ~(bare & (gaps.min(axis=1, initial=np.inf) < _AT_FACE))
        if not (len(places) and kept.any()):
            return 0.0
        return float(-heights[:, kept].max(axis=1).min())

    @cached_property
    def corners(self) -> FloatArray:
        """Corners of the triangles that it is made of, (T, 3, 3): of a sheet, its own.

        Others that meet its plane have their edges in it.
        """
        corners = self.faces
        if not self.is_sheet:
            return corners
        axis, middle = principal_axes(self.points)[:1], self.points.mean(axis=0)
        heights = coordinates_along(axis, corners - middle)[..., 0]
        own: FloatArray = corners[(np.abs(heights) < _AT_FACE).all(axis=1)]
        return own

    @cached_property
    def places(self) -> FloatArray:
        """A point of each chord in it, (C, 3)."""
        places: FloatArray = self.solid.chords[self.chords]
        return places

    @cached_property
    def lines(self) -> tuple[FloatArray, FloatArray]:
        """The lines in which two of the planes meet, see `lines_of`."""
        return lines_of(self.planes)


def whole(solid: Solid, fit: Fit) -> Cell:
    """Return the whole solid as one piece.

    Parameters
    ----------
    solid : Solid
    fit : Fit
    """
    return Cell(
        solid.vertices,
        solid.samples,
        solid.triangles,
        np.arange(len(solid.chords)),
        solid,
        fit,
        np.zeros((0, 3)),
        -1,
        solid.corners,
        np.zeros((0, 4)),
    )


def cut(cell: Cell, plane: FloatArray) -> tuple[Cell, Cell]:
    """Cut a piece in two by a plane.

    Parameters
    ----------
    cell : Cell
    plane : (4,) float
        Unit normal n and offset d: n · x + d = 0 on the plane.

    Returns
    -------
    below, above : Cell
        Either may be empty.
    """
    section = cross_section(cell.corners, plane)
    face = section.spread(cell.points)
    face = face[(heights_above(cell.planes, face) <= 0).all(axis=1)]
    rim = segments_below(cell.planes, section.rim).reshape(-1, 3)
    if not cell.is_sheet:  # it has no inside, even where it is a wall of a solid
        tips = meeting_points(cell.lines, cell.planes, plane)
        rim = np.concatenate([rim, tips[section.holds(tips)]])
    heights = [
        heights_above(plane[None], places)[:, 0]
        for places in (cell.points, cell.boundary, cell.places)
    ]
    below = [each <= 0 for each in heights]
    # Points in the plane are on both sides, but volumes count once.
    above = [*(each >= 0 for each in heights[:2]), ~below[2]]
    return _side(cell, plane, below, rim, face), _side(cell, -plane, above, rim, face)


def _side(
    cell: Cell,
    plane: FloatArray,
    kept: list[BoolArray],
    rim: FloatArray,
    face: FloatArray,
) -> Cell:
    """Return the side of a cell below a plane; `rim` and `face` lie in the plane.

    `kept` says which points, samples and chords are on that side.
    """
    points, boundary, chords = kept
    return Cell(
        np.concatenate([cell.points[points], rim]),
        np.concatenate([cell.boundary[boundary], face]),
        np.concatenate([cell.triangles[boundary], np.full(len(face), -1)]),
        cell.chords[chords],
        cell.solid,
        cell.fit,
        cell.all_witnesses,
        cell.part,
        cell.faces,
        np.concatenate([cell.planes, plane[None]]),
    )
