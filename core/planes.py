"""Planes fitted to the nearest points of each point of a cloud."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from .progress import Progress, Steps
from .splats import placed, spacing_of

# Points that a plane is fitted to where there is no noise, some, and much of it: more
# average it, fewer see thin walls.
FEWEST, _MORE, MOST = 10, 16, 24
# How thick the points around the flattest fifth of places are where the others begin.
_FLATTEST = 0.2
_SOME, _MUCH = 0.25, 0.5
# Points this thick, in their width, are no surface.
_NONE = 0.6
# Points that tell how many to take.
_PROBES = 1000
# Points whose planes are fitted at a time.
_FITS_PER_STEP = 2**15


@dataclass(frozen=True, eq=False)
class Planes:
    """Planes through the nearest points of each.

    Attributes
    ----------
    centers : (N, 3) float
        The mean of these points.
    axes : (N, 3) float
        Normals, of either sign.
    thickness : (N,) float
        How far points are off the plane, in their spread along it.
    """

    centers: NDArray[np.float64]
    axes: NDArray[np.float64]
    thickness: NDArray[np.float64]

    @property
    def trust(self) -> NDArray[np.float64]:
        """From 0, the points are no surface, to 1, they are a plane, (N,)."""
        return np.clip(1.0 - self.thickness / _NONE, 0.0, 1.0)

    def of(self, rows: NDArray[np.int64]) -> Planes:
        """Return some of the planes."""
        return Planes(self.centers[rows], self.axes[rows], self.thickness[rows])

    def feet(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the points (N, 3) moved onto their planes."""
        heights = ((self.centers - points) * self.axes).sum(axis=1)
        moved: NDArray[np.float64] = points + heights[:, None] * self.axes
        return moved


def enough_neighbors(points: NDArray[np.float64]) -> int:
    """Return how many nearest points show planes through the noise."""
    probes = points[:: -(-len(points) // _PROBES)]
    planes = _fitted(points, cKDTree(points), probes, FEWEST)
    thickness = np.quantile(planes.thickness, _FLATTEST)  # others may be at edges
    if thickness < _SOME:
        return FEWEST
    return _MORE if thickness < _MUCH else MOST


def fit_planes(
    points: NDArray[np.float64],
    n_neighbors: int,
    normals: NDArray[np.float64] | None = None,
) -> Steps[Planes]:
    """Return the planes through the points around each, by principal components.

    Parameters
    ----------
    points : (N, 3) float
    n_neighbors : int
    normals : (N, 3) float, optional
        With them the far side of a thin wall does not count as near.
    """
    places = points
    if normals is not None:
        places = placed(points, normals, spacing_of(points))
    tree, found = cKDTree(places), []
    for start in range(0, len(points), _FITS_PER_STEP):
        yield Progress("Normals", start / len(points))
        rows = slice(start, start + _FITS_PER_STEP)
        found.append(_fitted(points, tree, places[rows], n_neighbors))
    return Planes(
        np.concatenate([planes.centers for planes in found]),
        np.concatenate([planes.axes for planes in found]),
        np.concatenate([planes.thickness for planes in found]),
    )


def _fitted(
    points: NDArray[np.float64],
    tree: cKDTree,
    places: NDArray[np.float64],
    n_neighbors: int,
) -> Planes:
    """Return the planes through the points that a tree of them has near places."""
    _, nearest = tree.query(places, min(n_neighbors, tree.n))
    near = points[nearest]
    centers = near.mean(axis=1)
    spread = near - centers[:, None]
    covariances = np.einsum("nki,nkj->nij", spread, spread)
    variances, axes = np.linalg.eigh(covariances)
    variances = np.maximum(variances, np.finfo(float).tiny)
    thickness = np.sqrt(variances[:, 0] / variances[:, 1])
    return Planes(centers, axes[:, :, 0], thickness)
