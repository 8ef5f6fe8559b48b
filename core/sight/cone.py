"""Sparse lines of sight, from a cone of rays at each sample (section 5)."""

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

# Number of random pairs that psi is estimated from. The estimate is unbiased; its
# standard error is about 0.002.
_UNIFORM_PAIRS = 60_000


def cone_directions(
    normals: NDArray[np.float64], n_rays: int, opening: float
) -> NDArray[np.float64]:
    """Return directions spread evenly in a cone around each inward normal.

    Parameters
    ----------
    normals : (N, 3) float
        Outward unit vectors.
    n_rays : int
        Directions r in each cone.
    opening : float
        Full angle of the cone in radians.

    Returns
    -------
    directions : (N, r, 3) float
        Unit vectors, on a spiral. Each covers the same solid angle.
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
    """Return directions in a plane, spread evenly around each inward normal.

    Parameters
    ----------
    normals : (N, 3) float
        Outward unit vectors in the plane.
    n_rays : int
        Directions r in each fan.
    opening : float
        Full angle of the fan in radians.
    plane : (3,) float
        Unit normal of the plane.

    Returns
    -------
    directions : (N, r, 3) float
        Unit vectors in the plane.
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
    """Find visible and hidden pairs of samples with a cone of rays at each sample.

    These are the positive and the negative LoS matrix of section 5. A ray ends where it
    leaves the inside. The sample nearest to that point is visible from the sample that
    the ray starts at: an entry of the positive matrix. Samples on the surfaces behind
    are hidden: entries of the negative matrix. Other pairs stay unknown.

    Parameters
    ----------
    shape : PreparedShape
        The rays of a flat shape stay in its plane.
    samples : Samples
        N points on the surface.
    views : Viewpoints
        Viewpoints of `samples`.
    n_rays : int
        Rays r of each sample.
    opening : float
        Full angle of the cone in radians.

    Returns
    -------
    Steps of PairVisibility
        Sparse matrices (N, N). Every sample sees itself.
    """
    n_samples, marcher = len(samples), shape.marcher
    if shape.plane is None:
        directions = cone_directions(samples.normals, n_rays, opening)
    else:
        directions = fan_directions(samples.normals, n_rays, opening, shape.plane)
    directions = directions.reshape(-1, 3)
    sources = np.repeat(np.arange(n_samples), n_rays)
    # Nearest by position and normal: the two sides of a thin wall are close, but their
    # normals point away from each other.
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
    """Find out whether random pairs of samples see each other.

    Parameters
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.
    samples : Samples
        N points on its surface.
    views : Viewpoints
        Viewpoints of `samples`.
    rng : numpy.random.Generator
        Draws the pairs uniformly, with replacement.

    Returns
    -------
    Steps of PairVisibility
        Sparse matrices (N, N) with the number of draws of each pair.
    """
    n_samples = len(samples)
    first, second = rng.integers(n_samples, size=(2, _UNIFORM_PAIRS))
    visible = yield from see_pairs(marcher, samples, views, first, second)

    def counted(chosen: NDArray[np.bool_]) -> sparse.csr_array:
        return pair_counts(first[chosen], second[chosen], n_samples)

    return PairVisibility(counted(visible), counted(np.ones_like(visible)))


def _symmetric(found: list[NDArray[np.int64]], n_samples: int) -> sparse.csr_array:
    """Return the symmetric matrix with 1 at each pair found and 0 elsewhere."""
    rows, columns = np.concatenate([np.zeros((2, 0), dtype=np.int64), *found], axis=1)
    matrix = pair_counts(rows, columns, n_samples)
    matrix.data[:] = 1.0
    return matrix
