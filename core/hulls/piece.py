"""Pieces of a solid: join them, and measure the errors of their hulls."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..geometry.primitives import CollisionShape, Hull
from ..steps.arrays import BoolArray, FloatArray, IntArray
from ..steps.progress import Progress, Steps
from .convex_hull import THIN, convex_hull
from .fitting import Fit
from .measure.error_bound import ErrorBound, ExactError
from .measure.estimate import estimated_depth, estimated_error, volume_error
from .solid import Solid

# In place of the triangle of a sample where another shell buries the surface.
BURIED = -2


@dataclass(frozen=True, eq=False)
class Piece:
    """One of the pieces that a solid is divided into; each gets a hull.

    The longest side of the solid is 2.

    Attributes
    ----------
    points : (C, 3) float
        Points with the same convex hull as the piece.
    boundary : (N, 3) float
        Samples of the surface in the piece, and of the faces that cuts made.
    triangles : (N,) int
        Triangle of the solid that each of these samples lies on, −1 on such faces, and
        `BURIED` where the piece is a shell that runs through others.
    chords : (C,) int
        Rows of the chords of the solid that are in the piece, ascending.
    solid : Solid
        The uncut solid.
    fit : Fit
        Which shape it gets.
    witnesses : (W, 3) float
        Points far outside of the solid, which shapes of larger pieces held.
    part : int
        Row of the part that it is, or most of it; −1 for what cuts made.
    """

    points: FloatArray
    boundary: FloatArray
    triangles: IntArray
    chords: IntArray
    solid: Solid
    fit: Fit
    witnesses: FloatArray
    part: int

    @property
    def on_surface(self) -> BoolArray:
        """Which samples of the boundary are on the surface, (N,)."""
        return self.triangles >= 0

    @cached_property
    def volume(self) -> float:
        """Volume of the solid in the piece."""
        return float(self.solid.volumes[self.chords].sum())

    @cached_property
    def hull(self) -> Hull:
        """Convex hull of the piece."""
        return convex_hull(self.points, THIN)

    @cached_property
    def shape(self) -> CollisionShape:
        """The shape that is written, as exactly as it is written."""
        return self.fit.shape(self.hull)

    @cached_property
    def rough_shape(self) -> CollisionShape:
        """A shape that is nearly the one that is written, made in far less time."""
        return self.fit.rough_shape(self.hull)

    @cached_property
    def added_volume(self) -> float:
        """Volume of the shape outside the solid; sampling may make it negative.

        Without the thickness of sheets: cuts would not make up for it.
        """
        shape, padding = self.rough_shape, self.hull.volume if self.is_sheet else 0.0
        inside = self.volume if shape.kind == "HULL" else self.solid.volume_in(shape)
        return shape.volume - padding - inside

    @cached_property
    def is_sheet(self) -> bool:
        """Whether it is flat. Films that cuts leave of a solid are no sheets."""
        may_be_sheet = not self.solid.closed or self.solid.volume == 0
        flat = may_be_sheet and self.hull.is_thickened
        return flat and bool(self.on_surface.all())

    @property
    def is_film(self) -> bool:
        """Whether it is what a cut beside a face of a solid left of it."""
        return self.hull.is_thickened and self.solid.closed and not self.is_sheet

    @property
    def extremes(self) -> FloatArray:
        """Few points with the same convex hull, not thickened, (M, 3)."""
        return self.points if self.is_sheet else self.hull.vertices

    @cached_property
    def least_error(self) -> float:
        """The terms of `error` that take least time."""
        depth = estimated_depth(self.rough_shape, self.boundary)
        return max(volume_error(self.added_volume), depth)

    @cached_property
    def error(self) -> float:
        """The error of the shape, estimated from samples: cheap, and often too low."""
        rest = self.boundary, self.witnesses, self.least_error
        return estimated_error(self.solid, self.rough_shape, self.hull, *rest)

    @cached_property
    def left_out(self) -> float:
        """How far the shape is from what `max_vertices` leaves out, see `Fit`."""
        return self.fit.left_out(self.shape, self.hull)

    @cached_property
    def bound(self) -> ErrorBound | ExactError:
        """An upper bound of the error, found when it is asked for."""
        rest = self.hull, self.fit.max_error, self.is_sheet
        return ErrorBound(self.solid, self.shape, *rest)

    @property
    def may_be_close(self) -> bool:
        """Whether the error may be within the largest one allowed, by its estimate.

        The estimate may be too large by the distance between samples. Samples of the
        surface itself that are too deep leave no doubt.
        """
        most = self.fit.max_error + self.solid.spacing
        return self.least_error <= most and not self._is_deep and self.error <= most

    @cached_property
    def _is_deep(self) -> bool:
        """Whether samples of the surface are surely deeper than what is allowed."""
        if not self.fit.is_sharp(self.rough_shape):
            return False
        depth = estimated_depth(self.rough_shape, self.boundary[self.on_surface])
        return depth > self.fit.max_error + THIN

    @cached_property
    def is_close(self) -> bool:
        """Whether the error of the shape is surely within the largest one allowed."""
        return self.may_be_close and self.bound.is_allowed

    def whether_close(self, stage: str) -> Steps[bool]:
        """Return `is_close`; what it takes is found in steps of their own."""
        progress = Progress(stage, 0.0)
        yield progress
        _ = self.hull
        yield progress
        if self.may_be_close:
            _ = self.shape
            yield progress
        return self.is_close

    @property
    def known_error(self) -> float:
        """The largest error that is known of the shape, without measuring it anew."""
        bound = self.__dict__.get("bound")
        return max(self.error, bound.known) if bound else self.error

    @property
    def all_witnesses(self) -> FloatArray:
        """Witnesses, with the far point that was found when the piece was measured."""
        bound = self.__dict__.get("bound")
        return np.concatenate([self.witnesses, *([bound.place] if bound else [])])


def piece_of_part(solid: Solid, fit: Fit, parts: IntArray, row: int) -> Piece:
    """Return a part of the surface as a piece, with the inside that is nearest to it.

    Parameters
    ----------
    solid : Solid
    fit : Fit
    parts : (T,) int
        Row of the part of each triangle.
    row : int
        That of the piece.

    Returns
    -------
    Piece
    """
    chosen = parts == row
    samples = chosen[solid.triangles]
    return Piece(
        solid.corners[chosen].reshape(-1, 3),
        solid.samples[samples],
        solid.triangles[samples],
        np.flatnonzero(samples[solid.samples_of_chords]),
        solid,
        fit,
        np.zeros((0, 3)),
        row,
    )


def join(one: Piece, other: Piece) -> Piece:
    """Join two pieces; the samples of the cut face between them are removed.

    So are those that one buries of the other.

    Parameters
    ----------
    one, other : Piece
    """
    kept = [_not_buried(one, other), _not_buried(other, one)]
    boundary = np.concatenate([one.boundary[kept[0]], other.boundary[kept[1]]])
    triangles = np.concatenate([one.triangles[kept[0]], other.triangles[kept[1]]])
    once = _rows_that_occur_once(boundary)
    return Piece(
        np.concatenate([one.extremes, other.extremes]),
        boundary[once],
        triangles[once],
        np.union1d(one.chords, other.chords),
        one.solid,
        one.fit,
        np.concatenate([one.all_witnesses, other.all_witnesses]),
        max(one, other, key=lambda piece: round(piece.hull.volume, 6)).part,
    )


def _not_buried(piece: Piece, other: Piece) -> BoolArray:
    """Return which samples of a piece (N,) are not buried in another one."""
    kept = piece.triangles != BURIED
    rows = np.flatnonzero(~kept)
    kept[rows] = other.hull.heights(piece.boundary[rows]) >= 0
    return kept


def _rows_that_occur_once(points: FloatArray) -> IntArray:
    """Return the rows (M,) of points (N, 3) that equal no other; in some order."""
    # The same points have the same key; to sort by all coordinates takes longer.
    x, y, z = points.T
    order = np.argsort(x + np.sqrt(2) * y + np.sqrt(3) * z)
    same = (points[order[1:]] == points[order[:-1]]).all(axis=1)
    return order[~(np.r_[False, same] | np.r_[same, False])[: len(points)]]
