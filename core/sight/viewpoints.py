"""Points just below the surface that the rays of samples start at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..geometry.frames import frames
from ..geometry.sampling import Samples
from ..steps.arrays import BoolArray, FloatArray, IntArray
from ..steps.progress import Progress, Steps
from .ray_march import PASS, RayMarcher

# Depth of viewpoints below the surface, in diagonals of the bounding box.
_OFFSET = 1e-3
# The same for splats, in sizes of a splat; the larger of the two counts.
_OFFSET_OF_SPLAT = 0.5
# Largest depth as a share of the thickness, for thin shapes.
_OFFSET_OF_THICKNESS = 0.1


@dataclass(frozen=True, eq=False)
class Viewpoints:
    """Points just below the surface that the rays of the samples start at.

    Attributes
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.
    samples : Samples
        N points on its surface.
    positions : (N, 3) float
        Samples moved inwards along their normals.
    depths : (N,) int
        Number of closed shells around each viewpoint, with the sample's own shell.
    enclosed : (N,) bool
        Whether another closed shell is around the sample.
    """

    marcher: RayMarcher
    samples: Samples
    positions: FloatArray
    depths: IntArray
    enclosed: BoolArray

    def with_others(self, other: Viewpoints) -> Viewpoints:
        """Return these viewpoints, followed by others of the same shape."""
        own, others = self.samples, other.samples
        pairs = [
            (own.positions, others.positions),
            (own.normals, others.normals),
            (own.triangles, others.triangles),
            (self.positions, other.positions),
            (self.depths, other.depths),
            (self.enclosed, other.enclosed),
        ]
        columns: list[Any] = [np.concatenate(pair) for pair in pairs]
        return Viewpoints(self.marcher, Samples(*columns[:3]), *columns[3:])


def viewpoints(marcher: RayMarcher, samples: Samples) -> Steps[Viewpoints]:
    """Move samples below the surface and count the closed shells around them.

    Parameters
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.
    samples : Samples
        N points on its surface.

    Returns
    -------
    Steps of Viewpoints
        One for each sample.
    """
    found = []
    for rows in marcher.in_turns(len(samples)):
        yield Progress("Lines of sight", rows.start / len(samples))
        found.append(_of_some(marcher, samples.at(rows)))
    columns: list[Any] = [np.concatenate(each) for each in zip(*found, strict=True)]
    return Viewpoints(marcher, samples, *columns)


def _of_some(
    marcher: RayMarcher, samples: Samples
) -> tuple[FloatArray, IntArray, BoolArray]:
    """Return the positions, depths and enclosed ones of some viewpoints at once."""
    outwards = _tripod_directions(samples.normals)
    nudge = PASS * marcher.diagonal
    inwards = -samples.normals
    own = marcher.closed[samples.triangles].astype(np.int64)
    thickness = thickness_at(marcher, samples)
    deepest = max(_OFFSET * marcher.diagonal, _OFFSET_OF_SPLAT * marcher.splat_size)
    offsets = np.minimum(deepest, _OFFSET_OF_THICKNESS * thickness)
    offsets = np.maximum(offsets, nudge)
    positions = samples.positions + offsets[:, None] * inwards
    outside = samples.positions + nudge * samples.normals
    return (
        positions,
        np.maximum(marcher.shells_around(positions, outwards), own),
        marcher.shells_around(outside, outwards) > 0,
    )


def thickness_at(marcher: RayMarcher, samples: Samples) -> FloatArray:
    """Return the length inside the shape of a ray straight inwards from each sample.

    Parameters
    ----------
    marcher : RayMarcher
        Rays through the inside of the shape.
    samples : Samples
        N points on its surface.

    Returns
    -------
    (N,) float
    """
    inwards = -samples.normals
    starts = samples.positions + PASS * marcher.diagonal * inwards
    around = marcher.closed[samples.triangles].astype(np.int64)
    far = np.full(len(samples), 2 * marcher.diagonal)
    return marcher.march(starts, inwards, far, around)[1]


def _tripod_directions(normals: FloatArray) -> list[FloatArray]:
    """Return three directions around each normal (N, 3), 30° off it and well apart."""
    axes = frames(normals)
    turns = 2 * np.pi * np.arange(3) / 3
    return [
        normals * np.sqrt(0.75)
        + 0.5 * (axes[0] * np.cos(turn) + axes[1] * np.sin(turn))
        for turn in turns
    ]
