"""Sparse lines of sight, from a cone of rays at each sample (section 5)."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ..geometry.directions import cone_directions, fan_directions
from ..geometry.frames import with_normals
from ..geometry.sampling import Samples
from ..parameters.parts import Parameters
from ..steps.arrays import FloatArray, IntArray
from ..steps.progress import Progress, Steps
from .pair_visibility import PairVisibility, pair_counts
from .prepared import PreparedShape
from .viewpoints import Viewpoints

# Rays of each sample if the user sets no number, as in the paper.
_USUAL_RAYS = 30
# Number of random pairs that psi is estimated from. The estimate is unbiased; its
# standard error is about 0.002.
_UNIFORM_PAIRS = 60_000
# Pairs of samples, (2, M) each.
Pairs: TypeAlias = list[IntArray]


def shared_rays(parameters: Parameters, n_samples: int) -> tuple[int, int]:
    """Return how many random pairs are cast, and how many rays each cone has left.

    Parameters
    ----------
    parameters : Parameters
        `psi_pairs` and `rays` are used. Pairs take at most half of the rays.
    n_samples : int

    Returns
    -------
    n_pairs, n_rays : int
        Of all samples together, and of each sample; 0 rays are as many as usual.
    """
    n_rays = parameters.rays
    if parameters.psi_pairs != "UNIFORM":
        return 0, n_rays
    if n_rays == 0:
        return _UNIFORM_PAIRS, 0
    n_pairs = min(_UNIFORM_PAIRS, n_rays // 2 * n_samples)
    return n_pairs, n_rays - -(-n_pairs // n_samples)


def see_cones(
    shape: PreparedShape, views: Viewpoints, n_rays: int, opening: float
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
    views : Viewpoints
        Those of N samples.
    n_rays : int
        Rays r of each sample; 0 casts as many as the paper.
    opening : float
        Full angle of the cone in radians.

    Returns
    -------
    Steps of PairVisibility
        Sparse matrices (N, N). Every sample sees itself.
    """
    samples, marcher, n_rays = views.samples, views.marcher, n_rays or _USUAL_RAYS
    n_samples = len(samples)
    directions = _directions(shape, samples, n_rays, opening)
    sources = np.repeat(np.arange(n_samples), n_rays)
    # Nearest by position and normal: the two sides of a thin wall are close, but their
    # normals point away from each other.
    scale = float(np.sqrt(marcher.mesh.areas.sum() / n_samples))
    tree = cKDTree(with_normals(samples.positions, samples.normals, scale))
    seen_and_hidden: tuple[Pairs, Pairs] = [], []
    for rays in marcher.in_turns(len(sources)):
        yield Progress("Lines of sight", rays.start / len(sources))
        origins, depths = views.positions[sources[rays]], views.depths[sources[rays]]
        hits = marcher.surfaces_along(origins, directions[rays], depths)
        for order, (rows, points, triangles) in enumerate(hits):
            keys = with_normals(points, marcher.normals[triangles], scale)
            found = np.stack([sources[rays][rows], tree.query(keys)[1]])
            seen_and_hidden[order > 0].append(found)
    return _matrices(*seen_and_hidden, n_samples)


def _directions(
    shape: PreparedShape, samples: Samples, n_rays: int, opening: float
) -> FloatArray:
    """Return the directions of the rays, (N r, 3): in a fan for a flat shape."""
    if shape.plane is None:
        directions = cone_directions(samples.normals, n_rays, opening)
    else:
        directions = fan_directions(samples.normals, n_rays, opening, shape.plane)
    return directions.reshape(-1, 3)


def _matrices(seen: Pairs, hidden: Pairs, n_samples: int) -> PairVisibility:
    """Return the positive matrix, and the known pairs: positive or negative."""
    positive = _symmetric(seen, n_samples)
    positive.setdiag(1.0)
    negative = _symmetric(hidden, n_samples)
    negative = sparse.csr_array(negative - negative * positive)
    negative.eliminate_zeros()
    known = positive + negative
    return PairVisibility(positive, known, (known.nnz - n_samples) // 2)


def _symmetric(found: Pairs, n_samples: int) -> sparse.csr_array:
    """Return the symmetric matrix with 1 at each pair found and 0 elsewhere."""
    rows, columns = np.concatenate([np.zeros((2, 0), dtype=np.int64), *found], axis=1)
    matrix = pair_counts(rows, columns, n_samples)
    matrix.data[:] = 1.0
    return matrix
