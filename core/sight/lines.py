"""Lines of sight between samples, through the inside (sections 3 and 5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.frames import frames
from ..geometry.sampling import Samples
from ..steps.progress import Progress, Steps, within
from .pairs import PairVisibility
from .ray_march import PASS, RayMarcher

# Rays between two reports of progress, about 20 ms.
RAYS_PER_STEP = 4096
# Pairs whose facing is looked up at a time.
_PAIRS_PER_BLOCK = 65536
# Samples look from this far under the surface, in diagonals of the bounding box or in
# grains of splats, or from this share of the thickness where the shape is thinner.
_OFFSET = 1e-3
_OFFSET_OF_GRAIN = 0.5
_OFFSET_OF_THICKNESS = 0.1


@dataclass(frozen=True, eq=False)
class Viewpoints:
    """Where samples look from, and how they stand to the shells around them.

    Attributes
    ----------
    positions : (N, 3) float
        Samples moved inwards along their normals.
    depths : (N,) int
        Number of closed shells around each viewpoint, its own among them.
    enclosed : (N,) bool
        Whether another closed shell is around the sample.
    """

    positions: NDArray[np.float64]
    depths: NDArray[np.int64]
    enclosed: NDArray[np.bool_]


def viewpoints(marcher: RayMarcher, samples: Samples) -> Viewpoints:
    """Move `samples` under the surface and count the shells around them."""
    nudge = PASS * marcher.diagonal
    inwards = -samples.normals
    own = marcher.closed[samples.triangles].astype(np.int64)
    _, thickness, _ = marcher.march(
        samples.positions + nudge * inwards,
        inwards,
        np.full(len(samples), 2 * marcher.diagonal),
        own,
    )
    deepest = max(_OFFSET * marcher.diagonal, _OFFSET_OF_GRAIN * marcher.grain)
    offsets = np.minimum(deepest, _OFFSET_OF_THICKNESS * thickness)
    offsets = np.maximum(offsets, nudge)
    positions = samples.positions + offsets[:, None] * inwards
    outside = samples.positions + nudge * samples.normals
    return Viewpoints(
        positions,
        np.maximum(_shells_around(marcher, positions, samples.normals), own),
        _shells_around(marcher, outside, samples.normals) > 0,
    )


def _shells_around(
    marcher: RayMarcher, points: NDArray[np.float64], normals: NDArray[np.float64]
) -> NDArray[np.int64]:
    """Return the number of closed shells around each point, (N,)."""
    counts = [
        marcher.shells_around(points, directions)
        for directions in _outward_directions(normals)
    ]
    # The median: a ray that slips between triangles must not decide.
    return np.maximum(np.median(counts, axis=0), 0).astype(np.int64)


def faces_inside(
    marcher: RayMarcher,
    samples: Samples,
    views: Viewpoints,
    first: NDArray[np.int64],
    second: NDArray[np.int64],
) -> NDArray[np.bool_]:
    """Return whether segments leave `first` and reach `second` from the inside.

    A necessary condition that costs no ray: each end lies below the tangent plane of
    the other, or above it by no more than normals may be off, unless another shell
    encloses that end.
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
    """Return whether the samples of each pair are in line of sight.

    Parameters
    ----------
    marcher : RayMarcher
    samples : Samples
    views : Viewpoints
        Of `samples`.
    first, second : (M,) int
        The pairs, as rows of `samples`.

    Returns
    -------
    visible : (M,) bool
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
    """Return the LoS matrix of all pairs of samples (eq. 3).

    Parameters
    ----------
    marcher : RayMarcher
    samples : Samples
    views : Viewpoints
        Of `samples`.

    Returns
    -------
    Steps of PairVisibility
        Dense. A sample sees itself.
    """
    n_samples = len(samples)
    los = np.eye(n_samples, dtype=bool)
    start = 0
    while start < n_samples - 1:
        # Whole rows of the upper triangle, so that memory stays in bounds.
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


def _sees(
    marcher: RayMarcher,
    views: Viewpoints,
    first: NDArray[np.int64],
    second: NDArray[np.int64],
) -> NDArray[np.bool_]:
    """Return whether the inside holds the segment between each pair, (M,)."""
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


def _outward_directions(
    normals: NDArray[np.float64],
) -> list[NDArray[np.float64]]:
    """Return three directions around each normal, well apart, each (N, 3)."""
    axes = frames(normals)
    turns = 2 * np.pi * np.arange(3) / 3
    return [
        normals * np.sqrt(0.75)
        + 0.5 * (axes[0] * np.cos(turn) + axes[1] * np.sin(turn))
        for turn in turns
    ]
