"""Samples on the surface of a mesh, spread evenly or one per face."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..errors import DecompositionError
from ..steps.arrays import FloatArray, IntArray
from .cutting.halving import halved
from .frames import area_vectors
from .mesh import TriangleMesh

# Candidates per sample: one of each run of this length along the curve is picked.
_CANDIDATES = 16
# Least number of triangles of a mesh that the paper calls dense.
_DENSE_FACES = 2000
# Triangles that the paper subdivides meshes of fewer triangles to.
_UPSAMPLED_FACES = 3000
# Bits per axis of the grid that the space-filling curve runs through.
_CURVE_BITS = 16


@dataclass(frozen=True, eq=False)
class Samples:
    """Points on a surface with their outward normals.

    Attributes
    ----------
    positions, normals : (N, 3) float
        In the space of the mesh. Normals are outward unit vectors.
    triangles : (N,) int
        Triangle that each sample lies on.
    """

    positions: FloatArray
    normals: FloatArray
    triangles: IntArray

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.positions)

    def at(self, rows: slice | IntArray) -> Samples:
        """Return some of the samples."""
        return Samples(self.positions[rows], self.normals[rows], self.triangles[rows])


def take_samples(
    mesh: TriangleMesh,
    rows: IntArray,
    sampling: str,
    n_samples: int,
    rng: np.random.Generator,
) -> Samples:
    """Take samples on some triangles of a mesh.

    Parameters
    ----------
    mesh : TriangleMesh
    rows : (R,) int
        The triangles, ascending.
    sampling : str
        'AREA' spreads the samples evenly, 'FACES' takes one on each triangle.
    n_samples : int
        Number of samples for 'AREA'; ignored for 'FACES'.
    rng : numpy.random.Generator

    Returns
    -------
    Samples

    Raises
    ------
    DecompositionError
        If these triangles have no area.
    """
    some = mesh
    if len(rows) < len(mesh.triangles):
        if mesh.areas[rows].sum() <= 0:
            raise DecompositionError(
                "The part has no area outside that samples could lie on; choose another"
                " one."
            )
        some = replace(mesh, triangles=mesh.triangles[rows], polygons=0 * rows)
    if sampling == "FACES":
        samples = sample_faces(some)
    else:
        samples = sample_surface(some, n_samples, rng)
    return replace(samples, triangles=rows[samples.triangles])


def sample_surface(
    mesh: TriangleMesh, n_samples: int, rng: np.random.Generator
) -> Samples:
    """Draw samples that each stand for the same area of the surface.

    Candidates are drawn uniformly by area and sorted along a Morton curve. One is
    picked at random from each run of consecutive candidates. The result therefore does
    not depend on the tessellation, and every region gets its share of the samples to
    within one or two.

    Parameters
    ----------
    mesh : TriangleMesh
        With positive area.
    n_samples : int
        Number of samples N.
    rng : numpy.random.Generator

    Returns
    -------
    Samples
    """
    triangles, weights = _drawn(mesh.areas, n_samples * _CANDIDATES, rng)
    corners = mesh.vertices[mesh.triangles[triangles]]
    candidates = np.einsum("nc,ncd->nd", weights, corners)
    runs = np.argsort(_morton_codes(candidates), kind="stable")
    runs = runs.reshape(n_samples, _CANDIDATES)
    chosen = runs[np.arange(n_samples), rng.integers(_CANDIDATES, size=n_samples)]
    picked = triangles[chosen]
    return Samples(candidates[chosen], mesh.normals[picked], picked)


def points_on(
    corners: FloatArray, n_points: int, rng: np.random.Generator
) -> tuple[IntArray, FloatArray]:
    """Draw points on triangles, uniformly by area.

    Parameters
    ----------
    corners : (T, 3, 3) float
        Corners of each triangle.
    n_points : int
        Number of points N.
    rng : numpy.random.Generator

    Returns
    -------
    triangles : (N,) int
        Triangle that each point lies on, ascending.
    points : (N, 3) float
    """
    areas = np.linalg.norm(area_vectors(corners), axis=1) / 2
    triangles, weights = _drawn(areas, n_points, rng)
    points: FloatArray = np.einsum("nc,ncd->nd", weights, corners[triangles])
    return triangles, points


def _drawn(
    areas: FloatArray, n_points: int, rng: np.random.Generator
) -> tuple[IntArray, FloatArray]:
    """Draw triangles (N,) by area, and weights (N, 3) of their corners."""
    cumulative = np.cumsum(areas)
    # Systematic sampling: one draw from each equal slice of the cumulative area.
    draws = (np.arange(n_points) + rng.random(n_points)) / n_points
    triangles = np.searchsorted(cumulative, draws * cumulative[-1], side="right")
    triangles = np.minimum(triangles, len(cumulative) - 1)
    root, split = np.sqrt(rng.random(n_points)), rng.random(n_points)
    weights = np.stack([1 - root, root * (1 - split), root * split], axis=1)
    return triangles, weights


def sample_faces(mesh: TriangleMesh) -> Samples:
    """Take the center of each triangle as a sample, as the paper does (section 5).

    If there are too few triangles, the largest ones are halved until there are enough.
    Triangles without area get no sample.

    Parameters
    ----------
    mesh : TriangleMesh
        With positive area.

    Returns
    -------
    Samples
        They stand for different areas, unlike those of `sample_surface`.
    """
    triangles = np.flatnonzero(mesh.areas > 0)
    corners, areas = mesh.vertices[mesh.triangles[triangles]], mesh.areas[triangles]
    enough = 0 if len(triangles) >= _DENSE_FACES else _UPSAMPLED_FACES
    while len(corners) < enough:
        largest = np.argsort(-areas, kind="stable")[: enough - len(corners)]
        largest = largest[areas[largest] > areas[largest[0]] / 2]
        some = corners[largest]
        lengths = np.linalg.norm(np.roll(some, -1, axis=1) - some, axis=2)
        corners[largest], others = np.split(halved(some, lengths), 2)
        areas[largest] /= 2
        corners = np.concatenate([corners, others])
        areas = np.concatenate([areas, areas[largest]])
        triangles = np.concatenate([triangles, triangles[largest]])
    return Samples(corners.mean(axis=1), mesh.normals[triangles], triangles)


def _spread() -> IntArray:
    """Return each number of a cell with two zeros after each of its bits, (2^bits,)."""
    cells, spread = np.arange(2**_CURVE_BITS), np.zeros(2**_CURVE_BITS, dtype=np.int64)
    for bit in range(_CURVE_BITS):
        spread |= ((cells >> bit) & 1) << (3 * bit)
    return spread


_SPREAD = _spread()


def _morton_codes(points: FloatArray) -> IntArray:
    """Return each point's place along a Z-order curve through the bounding cube."""
    low = points.min(axis=0)
    extent = float((points.max(axis=0) - low).max()) or 1.0
    cells = ((points - low) / extent * (2**_CURVE_BITS - 1)).astype(np.int64)
    x, y, z = _SPREAD[cells.T]
    return x | y << 1 | z << 2
