"""Pieces of a solid: cut them, join them, and measure the errors of their hulls."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..geometry.frames import heights_above
from ..geometry.primitives import Hull
from ..geometry.sampling import points_on
from .convex_hull import convex_hull
from .cross_section import cross_section
from .solid import Solid

# Weight k of the volume term in CoACD's concavity.
_VOLUME_WEIGHT = 0.3
# Largest number of samples times planes of a hull for which heights are computed.
_MOST_HEIGHTS = 500_000
# Number of samples on the surface of a hull.
_HULL_SAMPLES = 400
# Thickness of the hulls of flat pieces; the longest side of the shape is 2.
THIN = 2e-3
# Subtracted from the distance between a point and the nearest sample, as a share of
# the spacing: even points on the surface lie between samples.
_SLACK = 0.4
# Three planes meet in a point only if the determinant of their normals is above this.
_PARALLEL = 1e-4
# Height up to which a point counts as on a plane.
_ON_PLANE = 1e-9


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
    volume : float
        Volume of the solid in the piece.
    spacing : float
        Distance between neighboring surface samples.
    """

    points: NDArray[np.float64]
    boundary: NDArray[np.float64]
    volume: float
    spacing: float

    @cached_property
    def hull(self) -> Hull:
        """Convex hull of the piece."""
        return convex_hull(self.points, THIN)

    @property
    def added_volume(self) -> float:
        """Volume of the hull minus that of the piece; sampling may make it negative."""
        return self.hull.volume - self.volume

    @property
    def volume_error(self) -> float:
        """Radius of a ball of the added volume, times k (R_v of CoACD)."""
        return volume_error(self.added_volume)

    @cached_property
    def error(self) -> float:
        """CoACD's concavity: the larger of R_v and the Hausdorff distance H_b.

        H_b is the largest distance between the surfaces of the piece and of its hull,
        from samples on both. Wei, Liu, Ling and Su 2022, "Approximate Convex
        Decomposition for 3D Meshes with Collision-Aware Concavity and Tree Search",
        section 4.
        """
        if len(self.boundary) == 0:
            return self.volume_error
        n_heights = len(self.boundary) * len(self.hull.planes)
        few = self.boundary[:: -(-n_heights // _MOST_HEIGHTS)]
        depth = -self.hull.heights(few).min()
        tree = cKDTree(np.concatenate([self.boundary, self.hull.vertices]))
        rng = np.random.default_rng(0)
        _, spread = points_on(self.hull.corners, _HULL_SAMPLES, rng)
        away = tree.query(spread)[0].max()
        return max(self.volume_error, depth, away - _SLACK * self.spacing)


@dataclass(frozen=True, eq=False)
class Cell(Piece):
    """A piece bounded by planes, which can be cut again.

    Attributes
    ----------
    on_surface : (N,) bool
        Which samples of `boundary` are on the surface, not on a face that a cut made.
    chords : (C, 3) float
        Centers of the chords in the piece.
    volumes : (C,) float
        Volume around each chord.
    planes : (P, 4) float
        Unit normal n and offset d of each plane: n · x + d ≤ 0 in the piece.
    """

    on_surface: NDArray[np.bool_]
    chords: NDArray[np.float64]
    volumes: NDArray[np.float64]
    planes: NDArray[np.float64]


def whole(solid: Solid) -> Cell:
    """Return the whole solid as one piece.

    Parameters
    ----------
    solid : Solid
    """
    return Cell(
        solid.vertices,
        solid.samples,
        float(solid.volumes.sum()),
        solid.spacing,
        np.ones(len(solid.samples), dtype=bool),
        solid.chords,
        solid.volumes,
        np.zeros((0, 4)),
    )


def piece_of_part(solid: Solid, chosen: NDArray[np.bool_]) -> Piece:
    """Return a part of the surface as a piece, with the inside that is nearest to it.

    Parameters
    ----------
    solid : Solid
    chosen : (T,) bool
        Which triangles belong to the part.

    Returns
    -------
    Piece
    """
    samples = chosen[solid.triangles]
    nearest = cKDTree(solid.samples).query(solid.chords)[1]
    return Piece(
        solid.corners[chosen].reshape(-1, 3),
        solid.samples[samples],
        float(solid.volumes[samples[nearest]].sum()) if len(solid.chords) else 0.0,
        solid.spacing,
    )


def cut(solid: Solid, cell: Cell, plane: NDArray[np.float64]) -> tuple[Cell, Cell]:
    """Cut a piece in two by a plane.

    Parameters
    ----------
    solid : Solid
        The uncut solid.
    cell : Cell
        The piece of it to cut.
    plane : (4,) float
        Unit normal n and offset d: n · x + d = 0 on the plane.

    Returns
    -------
    below, above : Cell
        Either may be empty.
    """
    section = cross_section(solid, plane)
    face = section.spread(cell.points)
    face = face[(heights_above(cell.planes, face) <= 0).all(axis=1)]
    tips = _meeting_points(cell.planes, plane)
    rim = np.concatenate([section.rim_within(cell.planes), tips[section.holds(tips)]])
    return _side(cell, plane, rim, face), _side(cell, -plane, rim, face)


def join(one: Piece, other: Piece) -> Piece:
    """Join two pieces; the samples of the cut face between them are removed.

    Parameters
    ----------
    one, other : Piece
    """
    boundary, counts = np.unique(
        np.concatenate([one.boundary, other.boundary]), axis=0, return_counts=True
    )
    return Piece(
        np.concatenate([one.hull.vertices, other.hull.vertices]),
        boundary[counts == 1],
        one.volume + other.volume,
        one.spacing,
    )


def _side(
    cell: Cell,
    plane: NDArray[np.float64],
    rim: NDArray[np.float64],
    face: NDArray[np.float64],
) -> Cell:
    """Return the side of a cell below a plane; `rim` and `face` lie in the plane."""
    points, boundary, chords = (
        heights_above(plane[None], places)[:, 0] <= 0
        for places in (cell.points, cell.boundary, cell.chords)
    )
    return Cell(
        np.concatenate([cell.points[points], rim]),
        np.concatenate([cell.boundary[boundary], face]),
        float(cell.volumes[chords].sum()),
        cell.spacing,
        np.concatenate([cell.on_surface[boundary], np.zeros(len(face), dtype=bool)]),
        cell.chords[chords],
        cell.volumes[chords],
        np.concatenate([cell.planes, plane[None]]),
    )


def volume_error(volume: float) -> float:
    """Return the error R_v of CoACD, weight k included, of an added volume.

    Parameters
    ----------
    volume : float
    """
    return float(_VOLUME_WEIGHT * np.cbrt(3 * abs(volume) / (4 * np.pi)))


def _meeting_points(
    planes: NDArray[np.float64], plane: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the corners of a cell where a plane meets two others, (M, 3).

    Such corners may lie inside the solid, where no triangle has a vertex.
    """
    one, other = np.triu_indices(len(planes), 1)
    triples = np.stack([planes[one], planes[other], plane + 0 * planes[one]], axis=1)
    firm = np.abs(np.linalg.det(triples[:, :, :3])) > _PARALLEL
    points: NDArray[np.float64] = np.linalg.solve(
        triples[firm, :, :3], -triples[firm, :, 3:]
    )[..., 0].astype(np.float64)
    return points[(heights_above(planes, points) <= _ON_PLANE).all(axis=1)]
