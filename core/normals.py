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
# Times that planes are fitted to noisy points once their sides are known: lines of
# sight along a thin board need it smooth. Clouds of fewer points would lose limbs.
_FITS = 3
_DENSE = 3000
# A flux through the surface below this share of the greatest one is an inward one, and
# what is added to that share for each share of the surface that is missing.
_CLEARLY_INWARDS = 0.05
_FOR_MISSING = 0.25


def estimate_normals(
    points: NDArray[np.float64],
) -> Steps[NDArray[np.float64]]:
    """Return outward unit normals at points, (N, 3).

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
    noisy = n_neighbors > FEWEST
    feet = planes.feet(points) if noisy else points
    kept, _, _ = thinned_splats(feet, planes.axes)
    n_drawn = _DRAWN if n_neighbors < MOST else _DRAWN_FROM_NOISE
    guides = yield from within(_guides(feet[kept], planes.of(kept), n_drawn), 0.2, 0.9)
    _, nearest = cKDTree(feet[kept]).query(feet)
    if not noisy:
        return _sharpened(guides[nearest], planes)
    normals = _sharpened(guides, planes.of(kept))
    refined = _refined(points[kept], normals, n_neighbors)
    normals = yield from within(refined, 0.9, 1.0)
    return normals[nearest]


def _guides(
    points: NDArray[np.float64], planes: Planes, n_drawn: int
) -> Steps[NDArray[np.float64]]:
    """Return what planes and the whole shape say about normals, by trust, (N, 3)."""
    outward = yield from outward_directions(points, n_drawn)
    signs = agreed_signs(points, planes, outward)
    trust = planes.trust[:, None]
    return trust * signs[:, None] * planes.axes + (1 - trust) * outward


def _sharpened(guides: NDArray[np.float64], planes: Planes) -> NDArray[np.float64]:
    """Return unit normals (N, 3): planes are more exact than guides.

    As long as they do not cut across a thin limb.
    """
    along = np.einsum("nd,nd->n", guides, planes.axes)[:, None] * planes.axes
    return unit(guides + _EXACTNESS * along)


def _refined(
    points: NDArray[np.float64], normals: NDArray[np.float64], n_neighbors: int
) -> Steps[NDArray[np.float64]]:
    """Return normals of planes that are fitted to each side of thin limbs, (N, 3)."""
    n_fits = 1
    if len(points) >= _DENSE:
        n_neighbors, n_fits = MOST, _FITS
    for step in range(n_fits):
        fit = fit_planes(points, n_neighbors, normals)
        planes = yield from within(fit, step / n_fits, (step + 1) / n_fits)
        points = planes.feet(points)
        turns = np.where((planes.axes * normals).sum(axis=1) < 0, -1.0, 1.0)
        normals = turns[:, None] * planes.axes
    return normals


def face_inwards(points: NDArray[np.float64], normals: NDArray[np.float64]) -> bool:
    """Return whether normals point into what the points enclose, by its volume.

    Open surfaces enclose little for certain, the less the more is missing, and count as
    facing outwards: a single scan may show the hollow side of a bent board.
    """
    areas = areas_of_points(points, normals)
    arms = points - np.average(points, axis=0, weights=areas)
    fluxes = np.einsum("nd,nd->n", arms, normals)
    size = areas @ np.linalg.norm(arms, axis=1)
    # The normals of a closed surface add up to nothing.
    missing = np.linalg.norm(areas @ normals) / areas.sum()
    return bool(areas @ fluxes < -(_CLEARLY_INWARDS + _FOR_MISSING * missing) * size)


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
