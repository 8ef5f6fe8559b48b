"""Normals of point clouds: estimated where there are none, and turned outwards."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import cg
from scipy.spatial import cKDTree

from .planes import FEWEST, MOST, Planes, enough_neighbors, fit_planes
from .progress import Steps, within
from .splats import areas_of_points, thinned_splats
from .winding import outward_directions, unit

# Points that the closed shape is found from.
_DRAWN, _DRAWN_FROM_NOISE = 4000, 2000
# Neighbors that agree about the side, the weight of that beside what the whole shape
# says, and how fast it wanes with the angle between two planes.
_NEIGHBORS = 10
_AGREEMENT = 30.0
_SHARPNESS = 4
# Weight of the nearest plane beside the side that it faces to.
_EXACTNESS = 3.0
# A flux through the surface below this share of the greatest one is an inward one.
_CLEARLY_INWARDS = 0.1


def estimate_normals(
    points: NDArray[np.float64],
) -> Steps[tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Return points with less noise (N, 3), and outward unit normals there (N, 3).

    Where points are a surface, normals are those of planes through the nearest, and
    neighbors agree about the side. Where noise is as large as the distances of points,
    normals are what makes a closed shape of the whole; as these tell the two sides of
    thin limbs apart, planes are then fitted to each side again.

    Parameters
    ----------
    points : (N, 3) float
    """
    n_neighbors = enough_neighbors(points)
    planes = yield from within(fit_planes(points, n_neighbors), 0.0, 0.2)
    if n_neighbors == FEWEST:
        normals = yield from within(_faced(points, planes, _DRAWN), 0.2, 1.0)
        return points, normals
    n_drawn = _DRAWN if n_neighbors < MOST else _DRAWN_FROM_NOISE
    rough = _faced(planes.feet(points), planes, n_drawn)
    guides = yield from within(rough, 0.2, 0.9)
    planes = yield from within(fit_planes(points, n_neighbors, guides), 0.9, 1.0)
    turns = np.where((planes.axes * guides).sum(axis=1) < 0, -1.0, 1.0)
    return planes.feet(points), turns[:, None] * planes.axes


def _faced(
    points: NDArray[np.float64], planes: Planes, n_drawn: int
) -> Steps[NDArray[np.float64]]:
    """Return outward unit normals (N, 3) along planes, or what the whole shape says."""
    kept, _, _ = thinned_splats(points, planes.axes)
    few, few_planes = points[kept], planes.of(kept)
    outward = yield from outward_directions(few, n_drawn)
    signs = agreed_signs(few, few_planes, outward)
    trust = few_planes.trust[:, None]
    guides = trust * signs[:, None] * few_planes.axes + (1 - trust) * outward
    _, nearest = cKDTree(few).query(points)
    guides = guides[nearest]
    # Planes are more exact, as long as they do not cut across a thin limb.
    along = np.einsum("nd,nd->n", guides, planes.axes)[:, None] * planes.axes
    return unit(guides + _EXACTNESS * along)


def face_inwards(points: NDArray[np.float64], normals: NDArray[np.float64]) -> bool:
    """Return whether normals point into what the points enclose, by its volume.

    Open surfaces enclose little for certain and count as facing outwards.
    """
    areas = areas_of_points(points, normals)
    arms = points - np.average(points, axis=0, weights=areas)
    fluxes = np.einsum("nd,nd->n", arms, normals)
    size = areas @ np.linalg.norm(arms, axis=1)
    return bool(areas @ fluxes < -_CLEARLY_INWARDS * size)


def agreed_signs(
    points: NDArray[np.float64], planes: Planes, outward: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return 1 where the axis of a plane points outwards and -1 where inwards, (N,).

    Neighbors agree, the more the flatter the surface is there. This and what the whole
    shape says are weighed in one system of linear equations, which carries signs over
    the graph of neighbors.

    Parameters
    ----------
    points : (N, 3) float
    planes : Planes
        Through the points around each.
    outward : (N, 3) float
        What the whole shape says.
    """
    nearest = cKDTree(points).query(points, min(_NEIGHBORS, len(points)))[1][:, 1:]
    one, other = np.repeat(np.arange(len(points)), nearest.shape[1]), nearest.ravel()
    cosines = (planes.axes[one] * planes.axes[other]).sum(axis=1)
    weights = np.sign(cosines) * np.abs(cosines) ** _SHARPNESS
    weights *= planes.trust[one] * planes.trust[other]
    ties = sparse.coo_array((weights, (one, other)), shape=(len(points),) * 2).tocsr()
    ties = (ties + ties.T) / 2
    degrees = np.asarray(abs(ties).sum(axis=1)).ravel()
    system = sparse.diags_array(1.0 + _AGREEMENT * degrees) - _AGREEMENT * ties
    votes = (planes.axes * outward).sum(axis=1)
    beliefs, _ = cg(system, votes, rtol=1e-6, maxiter=1000)
    return np.where(beliefs < 0, -1.0, 1.0)
