"""Lines of sight between samples, through the inside (sections 3 and 5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ..geometry.sampling import Samples
from ..steps.progress import Progress, Steps, within
from .pair_visibility import PairVisibility, pair_counts
from .ray_march import RayMarcher
from .viewpoints import Viewpoints

# Rays between two reports of progress, about 20 ms.
RAYS_PER_STEP = 4096
# Pairs of the LoS matrix that are tested at a time.
_PAIRS_PER_BLOCK = 65536
# Number of random pairs that psi is estimated from. The estimate is unbiased; its
# standard error is about 0.002.
_UNIFORM_PAIRS = 60_000


def faces_inside(
    marcher: RayMarcher,
    samples: Samples,
    views: Viewpoints,
    first: NDArray[np.int64],
    second: NDArray[np.int64],
) -> NDArray[np.bool_]:
    """Test which pairs of samples face each other through the inside.

    Lines of sight need this, and it costs no ray: each end of a segment lies below the
    tangent plane of the other end. It may lie above by the error of the normals. Ends
    that another shell encloses are not tested.

    Parameters
    ----------
    marcher : RayMarcher
        Its `tilt` is the error of the normals.
    samples : Samples
        Points on the surface.
    views : Viewpoints
        Viewpoints of `samples`.
    first, second : (M,) int
        Rows of `samples` of each pair.

    Returns
    -------
    facing : (M,) bool
    """

    def below(ends: NDArray[np.int64], others: NDArray[np.int64]) -> NDArray[np.bool_]:
        towards = views.positions[others] - samples.positions[ends]
        heights = np.einsum("md,md->m", towards, samples.normals[ends])
        allowed = 0.0
        if marcher.tilt:
            allowed = marcher.tilt * np.linalg.norm(towards, axis=1)
        under: NDArray[np.bool_] = (heights < allowed) | views.enclosed[ends]
        return under

    return below(first, second) & below(second, first)


def see_pairs(
    marcher: RayMarcher,
    samples: Samples,
    views: Viewpoints,
    first: NDArray[np.int64],
    second: NDArray[np.int64],
) -> Steps[NDArray[np.bool_]]:
    """Find out which of the given pairs of samples are in line of sight.

    Parameters
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.
    samples : Samples
        Points on its surface.
    views : Viewpoints
        Viewpoints of `samples`.
    first, second : (M,) int
        Rows of `samples` of each pair.

    Returns
    -------
    Steps of (M,) bool
    """
    visible = first == second
    candidates = np.flatnonzero(
        ~visible & faces_inside(marcher, samples, views, first, second)
    )
    for start in range(0, len(candidates), RAYS_PER_STEP):
        yield Progress("Lines of sight", start / len(candidates))
        chunk = candidates[start : start + RAYS_PER_STEP]
        visible[chunk] = _sees(marcher, views, first[chunk], second[chunk])
    return visible


def see_all_pairs(
    marcher: RayMarcher, samples: Samples, views: Viewpoints
) -> Steps[PairVisibility]:
    """Compute the LoS matrix of all pairs of samples (eq. 3).

    Parameters
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.
    samples : Samples
        N points on its surface.
    views : Viewpoints
        Viewpoints of `samples`.

    Returns
    -------
    Steps of PairVisibility
        A dense matrix (N, N). Every sample sees itself.
    """
    n_samples = len(samples)
    los = np.eye(n_samples, dtype=bool)
    start = 0
    while start < n_samples - 1:
        # Take a few rows of the upper triangle at a time, to bound the memory.
        stop = start + max(1, _PAIRS_PER_BLOCK // (n_samples - start))
        rows = np.arange(start, min(stop, n_samples - 1))
        first = np.repeat(rows, n_samples - 1 - rows)
        second = np.concatenate([np.arange(row + 1, n_samples) for row in rows])
        done, share = (
            1 - ((n_samples - row) / n_samples) ** 2 for row in (start, rows[-1] + 1)
        )
        visible = yield from within(
            see_pairs(marcher, samples, views, first, second), done, share
        )
        los[first[visible], second[visible]] = True
        start = int(rows[-1]) + 1
    return PairVisibility((los | los.T).astype(np.float32), None)


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


def _sees(
    marcher: RayMarcher,
    views: Viewpoints,
    first: NDArray[np.int64],
    second: NDArray[np.int64],
) -> NDArray[np.bool_]:
    """Return whether the segment between each pair stays inside, (M,) bool."""
    segments = views.positions[second] - views.positions[first]
    lengths = np.linalg.norm(segments, axis=1)
    lengths = np.maximum(lengths, np.finfo(float).tiny)
    exits, _, _ = marcher.march(
        views.positions[first],
        segments / lengths[:, None],
        lengths,
        views.depths[first],
    )
    return exits < 0
