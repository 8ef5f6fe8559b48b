"""A shape as hulls are looked for in it: samples of its surface and of its inside."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.mesh import TriangleMesh
from ..geometry.sampling import sample_surface
from ..steps.progress import Progress, Steps
from .chords import chords_along

# Samples on the surface.
_SAMPLES = 6000
# Volume below which there is none, but noise, as of sheets with two sides; the longest
# side is 2.
_NO_VOLUME = 1e-6


@dataclass(frozen=True, eq=False)
class Solid:
    """A shape as hulls are looked for in it.

    Attributes
    ----------
    corners : (T, 3, 3) float
        Of its triangles.
    vertices : (V, 3) float
        Distinct.
    samples : (N, 3) float
        Spread evenly over the surface.
    triangles : (N,) int
        Triangle that each sample lies on.
    chords : (C, 3) float
        Centers of pieces of lines through the inside.
    volumes : (C,) float
        Volume that each stands for.
    spacing : float
        Distance between neighboring samples.
    """

    corners: NDArray[np.float64]
    vertices: NDArray[np.float64]
    samples: NDArray[np.float64]
    triangles: NDArray[np.int64]
    chords: NDArray[np.float64]
    volumes: NDArray[np.float64]
    spacing: float


def solid_of(mesh: TriangleMesh, seed: int) -> Steps[Solid]:
    """Return the inside of `mesh`.

    The volume is measured along lines parallel to each axis, which unlike cells of a
    grid miss no thin wall across them. Where a shape is open, lines find as much of an
    inside as they enter and leave.

    Parameters
    ----------
    mesh : TriangleMesh
        Oriented.
    seed : int

    Returns
    -------
    Steps of Solid
        Yields Progress; `run` gets the value.
    """
    samples = sample_surface(mesh, _SAMPLES, np.random.default_rng(seed))
    corners = mesh.vertices[mesh.triangles]
    centers, shares = [], []
    for axis in range(3):
        yield Progress("Solid", axis / 3)
        along, share = chords_along(corners, axis)
        centers.append(along)
        shares.append(share)
    yield Progress("Solid", 1.0)
    chords, volumes = np.concatenate(centers), np.concatenate(shares) / 3
    if volumes.sum() < _NO_VOLUME:
        chords, volumes = chords[:0], volumes[:0]
    return Solid(
        corners,
        np.unique(corners.reshape(-1, 3), axis=0),
        samples.positions,
        samples.triangles,
        chords,
        volumes,
        float(np.sqrt(mesh.areas.sum() / _SAMPLES)),
    )
