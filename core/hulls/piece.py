"""Pieces of a solid: their hulls, how far these stray, cuts and joints."""

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
# Samples times faces of the hull that they are looked up to be behind, at most.
_MOST_HEIGHTS = 500_000
# Samples on a hull's surface.
_HULL_SAMPLES = 400
# Thickness of the hulls of flat pieces; the longest side of a shape is 2.
THIN = 2e-3
# Share of the distance between samples that a surface may seem off by.
_SLACK = 0.4
# Determinant of normals below which planes have no corner, and what counts as on one.
_PARALLEL = 1e-4
_ON_PLANE = 1e-9


@dataclass(frozen=True, eq=False)
class Piece:
    """Part of a solid.

    Attributes
    ----------
    points : (C, 3) float
        Points whose convex hull is that of the piece.
    boundary : (N, 3) float
        Samples on the surface within the piece and on the faces cut.
    volume : float
    spacing : float
        Distance between neighboring samples.
    """

    points: NDArray[np.float64]
    boundary: NDArray[np.float64]
    volume: float
    spacing: float

    @cached_property
    def hull(self) -> Hull:
        """The convex hull."""
        return convex_hull(self.points, THIN)

    @property
    def added_volume(self) -> float:
        """Volume that the hull adds; negative for what samples miss."""
        return self.hull.volume - self.volume

    @property
    def volume_error(self) -> float:
        """Radius of a ball as large as what the hull adds, times k (CoACD's R_v)."""
        return volume_error(self.added_volume)

    @cached_property
    def error(self) -> float:
        """CoACD's concavity: the larger of R_v and the Hausdorff distance H_b.

        Wei, Liu, Ling and Su 2022, "Approximate Convex Decomposition for 3D Meshes with
        Collision-Aware Concavity and Tree Search", section 4; H_b is the distance
        between the surfaces of the piece and of its hull, from samples on both.
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
    """A piece on one side of each of some planes, which can be cut further.

    Attributes
    ----------
    on_surface : (N,) bool
        Which samples of `boundary` are on no cut face.
    chords : (C, 3) float
        Pieces of lines through the inside.
    volumes : (C,) float
        Volume that each stands for.
    planes : (P, 4) float
        n · x + d ≤ 0 within.
    """

    on_surface: NDArray[np.bool_]
    chords: NDArray[np.float64]
    volumes: NDArray[np.float64]
    planes: NDArray[np.float64]


def whole(solid: Solid) -> Cell:
    """Return a solid uncut."""
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
    """Return a piece of the triangles `chosen` (T,) and the inside next to them.

    Lines through the inside belong to the part whose surface is nearest.
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
    """Return what lies below and above a plane (4,); either may be empty."""
    section = cross_section(solid, plane)
    face = section.spread(cell.points)
    face = face[(heights_above(cell.planes, face) <= 0).all(axis=1)]
    tips = _meeting_points(cell.planes, plane)
    rim = np.concatenate([section.rim_within(cell.planes), tips[section.holds(tips)]])
    return _side(cell, plane, rim, face), _side(cell, -plane, rim, face)


def join(one: Piece, other: Piece) -> Piece:
    """Return two pieces as one; a face between them, cut before, is gone."""
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
    """Return what of a cell lies below a plane, given its face there."""
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
    """Return the volume error (R_v times k) that an added volume makes."""
    return float(_VOLUME_WEIGHT * np.cbrt(3 * abs(volume) / (4 * np.pi)))


def _meeting_points(
    planes: NDArray[np.float64], plane: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return where a plane meets two others (P, 4) at a corner of their cell, (M, 3).

    Such corners may lie within the solid, where no triangle has a vertex.
    """
    one, other = np.triu_indices(len(planes), 1)
    triples = np.stack([planes[one], planes[other], plane + 0 * planes[one]], axis=1)
    firm = np.abs(np.linalg.det(triples[:, :, :3])) > _PARALLEL
    points: NDArray[np.float64] = np.linalg.solve(
        triples[firm, :, :3], -triples[firm, :, 3:]
    )[..., 0].astype(np.float64)
    return points[(heights_above(planes, points) <= _ON_PLANE).all(axis=1)]
