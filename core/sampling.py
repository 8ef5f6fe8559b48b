"""Samples spread evenly over the surface of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .shapes import TriangleMesh

# Candidates per sample: each sample is one of a run of neighbors on the curve.
_CANDIDATES = 16
# Bits per axis of the space-filling curve's grid.
_CURVE_BITS = 16


@dataclass(frozen=True, eq=False)
class Samples:
    """Oriented points on a surface, each standing for the same area.

    Attributes
    ----------
    positions, normals : (N, 3) float
        In the space of the mesh; normals are outward unit vectors.
    triangles : (N,) int
        Triangle that each sample lies on.
    """

    positions: NDArray[np.float64]
    normals: NDArray[np.float64]
    triangles: NDArray[np.int64]

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.positions)


def sample_surface(
    mesh: TriangleMesh, n_samples: int, rng: np.random.Generator
) -> Samples:
    """Draw samples of equal area, stratified along a space-filling curve.

    Candidates are drawn uniformly by area and sorted along a Morton curve; one is
    taken at random from each run of neighbors. The tessellation therefore leaves no
    trace, and every region gets its share to within a sample or two.

    Parameters
    ----------
    mesh : TriangleMesh
        With positive area.
    n_samples : int
        Number of samples N.
    rng : numpy.random.Generator
        Source of the randomness.

    Returns
    -------
    Samples
    """
    n_candidates = n_samples * _CANDIDATES
    cumulative = np.cumsum(mesh.areas)
    # Systematic draws: one per equal slice of the cumulative area.
    draws = (np.arange(n_candidates) + rng.random(n_candidates)) / n_candidates
    triangles = np.searchsorted(cumulative, draws * cumulative[-1], side="right")
    triangles = np.minimum(triangles, len(cumulative) - 1)
    corners = mesh.vertices[mesh.triangles[triangles]]
    root, split = np.sqrt(rng.random(n_candidates)), rng.random(n_candidates)
    weights = np.stack([1 - root, root * (1 - split), root * split], axis=1)
    candidates = np.einsum("nc,ncd->nd", weights, corners)
    runs = np.argsort(_morton_codes(candidates), kind="stable")
    runs = runs.reshape(n_samples, _CANDIDATES)
    chosen = runs[np.arange(n_samples), rng.integers(_CANDIDATES, size=n_samples)]
    picked = triangles[chosen]
    return Samples(candidates[chosen], mesh.normals[picked], picked)


def _morton_codes(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return each point's place along a Z-order curve through its bounding cube."""
    low = points.min(axis=0)
    extent = float((points.max(axis=0) - low).max()) or 1.0
    cells = ((points - low) / extent * (2**_CURVE_BITS - 1)).astype(np.int64)
    codes = np.zeros(len(points), dtype=np.int64)
    for bit in range(_CURVE_BITS):
        for axis in range(3):
            codes |= ((cells[:, axis] >> bit) & 1) << (3 * bit + axis)
    return codes
