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
# Pairs of the LoS matrix that are tested at a time.
_PAIRS_PER_BLOCK = 65536
# Depth of viewpoints below the surface, in diagonals of the bounding box.
_OFFSET = 1e-3
# The same for splats, in sizes of a splat; the larger of the two counts.
_OFFSET_OF_GRAIN = 0.5
# Largest depth as a share of the thickness, for thin shapes.
_OFFSET_OF_THICKNESS = 0.1


@dataclass(frozen=True, eq=False)
class Viewpoints:
    """Points just below the surface that the rays of the samples start at.

    Attributes
    ----------
    positions : (N, 3) float
        Samples moved inwards along their normals.
    depths : (N,) int
        Number of closed shells around each viewpoint, with the sample's own shell.
    enclosed : (N,) bool
        Whether another closed shell is around the sample.
    """

    positions: NDArray[np.float64]
    depths: NDArray[np.int64]
    enclosed: NDArray[np.bool_]


def viewpoints(marcher: RayMarcher, samples: Samples) -> Viewpoints:
    """Move samples below the surface and count the closed shells around them.

    Parameters
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.
    samples : Samples
        N points on its surface.

    Returns
    -------
    Viewpoints
        One for each sample.
    """
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
    # The median ignores one ray that slips through between two triangles.
    return np.maximum(np.median(counts, axis=0), 0).astype(np.int64)


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
