"""Sparse lines of sight: rays in a cone around the inward normal (section 5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.spatial import cKDTree

from ..geometry.frames import frames
from ..geometry.sampling import Samples
from ..steps.progress import Progress, Steps
from .lines import RAYS_PER_STEP, Viewpoints, see_pairs
from .pairs import PairVisibility, pair_counts
from .prepared import PreparedShape
from .ray_march import RayMarcher

# Random pairs for an unbiased psi: its standard error is about 0.002.
_UNIFORM_PAIRS = 60_000


def cone_directions(
    normals: NDArray[np.float64], n_rays: int, opening: float
) -> NDArray[np.float64]:
    """Return rays spread evenly in a cone around each inward normal.

    Parameters
    ----------
    normals : (N, 3) float
        Outward unit vectors.
    n_rays : int
        Rays r of each cone.
    opening : float
        Full angle of the cone in radians.

    Returns
    -------
    directions : (N, r, 3) float
        Unit vectors: a spiral of equal solid angles.
    """
    steps = np.arange(n_rays) + 0.5
    heights = 1.0 - steps / n_rays * (1.0 - np.cos(opening / 2))
    radii = np.sqrt(1.0 - heights**2)
    turns = steps * np.pi * (3.0 - np.sqrt(5.0))
    tangents, bitangents = frames(normals)
    return (
        -normals[:, None] * heights[:, None]
        + tangents[:, None] * (radii * np.cos(turns))[:, None]
        + bitangents[:, None] * (radii * np.sin(turns))[:, None]
    )


def fan_directions(
    normals: NDArray[np.float64],
    n_rays: int,
    opening: float,
    plane: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return rays spread evenly around each inward normal in a plane.

    Parameters
    ----------
    normals : (N, 3) float
        Outward unit vectors in the plane.
    n_rays : int
        Rays r of each fan.
    opening : float
        Full angle of the fan in radians.
    plane : (3,) float
        Normal of the plane, a unit vector.

    Returns
    -------
    directions : (N, r, 3) float
        Unit vectors.
    """
    angles = ((np.arange(n_rays) + 0.5) / n_rays - 0.5) * opening
    sideways = np.cross(plane, normals)
    return (
        -normals[:, None] * np.cos(angles)[:, None]
        + sideways[:, None] * np.sin(angles)[:, None]
    )


def see_cones(
    shape: PreparedShape,
    samples: Samples,
    views: Viewpoints,
    n_rays: int,
    opening: float,
) -> Steps[PairVisibility]:
    """Return the pairs that cones of rays find: the sparse LoS matrices of section 5.

    The sample nearest to where a ray leaves the inside is in line of sight with the
    ray's own: an entry of the positive matrix. Samples at the surfaces behind it are
    not: entries of the negative matrix. Nothing is known of other pairs.

    Parameters
    ----------
    shape : PreparedShape
        Rays stay in the plane of a flat shape.
    samples : Samples
    views : Viewpoints
        Of `samples`.
    n_rays : int
        Rays r a sample.
    opening : float
        Full angle of the cone in radians.

    Returns
    -------
    Steps of PairVisibility
        Sparse. A sample sees itself.
    """
    n_samples, marcher = len(samples), shape.marcher
    if shape.plane is None:
        directions = cone_directions(samples.normals, n_rays, opening)
    else:
        directions = fan_directions(samples.normals, n_rays, opening, shape.plane)
    directions = directions.reshape(-1, 3)
    sources = np.repeat(np.arange(n_samples), n_rays)
    # Two sides of a thin wall are near in space, but face away from each other.
    scale = float(np.sqrt(marcher.area / n_samples))
    tree = cKDTree(np.hstack([samples.positions, scale * samples.normals]))
    seen: list[NDArray[np.int64]] = []
    hidden: list[NDArray[np.int64]] = []
    for start in range(0, len(sources), RAYS_PER_STEP):
        yield Progress("Lines of sight", start / len(sources))
        rays = slice(start, start + RAYS_PER_STEP)
        hits = marcher.surfaces_along(
            views.positions[sources[rays]],
            directions[rays],
            views.depths[sources[rays]],
        )
        for order, (rows, points, triangles) in enumerate(hits):
            keys = np.hstack([points, scale * marcher.normals[triangles]])
            found = np.stack([sources[rays][rows], tree.query(keys)[1]])
            (hidden if order else seen).append(found)
    positive = _symmetric(seen, n_samples)
    positive.setdiag(1.0)
    negative = _symmetric(hidden, n_samples)
    negative = sparse.csr_array(negative - negative * positive)
    negative.eliminate_zeros()
    return PairVisibility(positive, positive + negative)


def see_uniform_pairs(
    marcher: RayMarcher,
    samples: Samples,
    views: Viewpoints,
    rng: np.random.Generator,
) -> Steps[PairVisibility]:
    """Return what is known from pairs of samples drawn uniformly at random."""
    n_samples = len(samples)
    first, second = rng.integers(n_samples, size=(2, _UNIFORM_PAIRS))
    visible = yield from see_pairs(marcher, samples, views, first, second)

    def counted(chosen: NDArray[np.bool_]) -> sparse.csr_array:
        return pair_counts(first[chosen], second[chosen], n_samples)

    return PairVisibility(counted(visible), counted(np.ones_like(visible)))


def _symmetric(found: list[NDArray[np.int64]], n_samples: int) -> sparse.csr_array:
    """Return the 0-1 matrix with entries at the pairs found, and their mirrors."""
    rows, columns = np.concatenate([np.zeros((2, 0), dtype=np.int64), *found], axis=1)
    matrix = pair_counts(rows, columns, n_samples)
    matrix.data[:] = 1.0
    return matrix
