"""Sample the surface and the inside of a mesh, to cut it and put hulls around it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.mesh import TriangleMesh
from ..geometry.sampling import sample_surface
from ..steps.progress import Progress, Steps
from .chords import chords_along

# Number of samples on the surface.
_SAMPLES = 6000
# A volume below this is noise, such as that of a two-sided sheet, and counts as 0; the
# longest side is 2.
_NO_VOLUME = 1e-6


@dataclass(frozen=True, eq=False)
class Solid:
    """A mesh with samples of its surface and chords through its inside.

    Attributes
    ----------
    corners : (T, 3, 3) float
        Corners of the triangles.
    vertices : (V, 3) float
        Distinct corners.
    samples : (N, 3) float
        Points spread evenly over the surface.
    triangles : (N,) int
        Triangle that each sample lies on.
    chords : (C, 3) float
        Centers of short chords along each axis.
    volumes : (C,) float
        Volume around each chord.
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
    """Sample the surface and the inside of a mesh.

    The volume is measured along lines parallel to each axis. Unlike the cells of a
    grid, such lines miss no thin wall across them. In an open mesh, a line counts as
    inside between a front face that it enters and a back face that it leaves.

    Parameters
    ----------
    mesh : TriangleMesh
        Oriented: normals point outwards. The longest side is 2.
    seed : int
        Seed of the random surface samples.

    Returns
    -------
    Steps of Solid
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
