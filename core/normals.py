"""Normals of point clouds: estimated where there are none, and turned outwards."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import cg
from scipy.spatial import cKDTree

from .cone import cone_directions
from .progress import Progress, Steps, within
from .scene import MakeCaster, RayCaster
from .sight import RAYS_PER_STEP
from .splats import areas_of_points, thinned_splats

# Points that a plane is fitted to: more average noise, fewer see thin walls.
_NEIGHBORS = 10
# Points whose planes are fitted at a time.
_FITS_PER_STEP = 2**16
# Rays to each side of a point, the full angle of their cone, and where they begin, in
# spacings of points.
_RAYS = 12
_CONE = np.radians(140.0)
_START = 0.5
# Beyond everything, in diagonals.
_FAR = 2.0
# Weight of agreeing with neighbors against what a point's own rays say, and how fast
# it wanes with the angle between two planes.
_AGREEMENT = 3.0
_SHARPNESS = 4
# A flux through the surface below this share of the greatest one is an inward one.
_CLEARLY_INWARDS = 0.1


def estimate_normals(
    points: NDArray[np.float64], make_caster: MakeCaster
) -> Steps[NDArray[np.float64]]:
    """Return outward unit normals of points, (N, 3).

    Parameters
    ----------
    points : (N, 3) float
        With a bounding box of diagonal 1.
    make_caster : callable
        Returns a RayCaster for splats of these points.
    """
    axes = yield from within(fit_planes(points), 0.0, 0.5)
    kept, areas, targets = thinned_splats(points, axes)
    few, few_axes = points[kept], axes[kept]
    signs = yield from within(
        outward_signs(
            few,
            few_axes,
            make_caster(targets),
            float(np.sqrt(areas.mean())),
        ),
        0.5,
        1.0,
    )
    outward = signs[:, None] * few_axes
    _, nearest = cKDTree(few).query(points)
    agree = np.einsum("nd,nd->n", axes, outward[nearest]) >= 0
    return np.where(agree[:, None], axes, -axes)


def face_inwards(points: NDArray[np.float64], normals: NDArray[np.float64]) -> bool:
    """Return whether normals point into what the points enclose, by its volume.

    Open surfaces enclose little for certain and count as facing outwards.
    """
    areas = areas_of_points(points, normals)
    arms = points - np.average(points, axis=0, weights=areas)
    fluxes = np.einsum("nd,nd->n", arms, normals)
    size = areas @ np.linalg.norm(arms, axis=1)
    return bool(areas @ fluxes < -_CLEARLY_INWARDS * size)


def fit_planes(points: NDArray[np.float64]) -> Steps[NDArray[np.float64]]:
    """Return the normals of planes through the points around each, (N, 3).

    Principal components of the nearest points. Which way a normal points is open: its
    largest component is made positive, so that most neighbors agree.
    """
    axes, tree = np.empty_like(points), cKDTree(points)
    for start in range(0, len(points), _FITS_PER_STEP):
        yield Progress("Normals", start / len(points))
        rows = slice(start, start + _FITS_PER_STEP)
        near = points[tree.query(points[rows], min(_NEIGHBORS, len(points)))[1]]
        spread = near - near.mean(axis=1, keepdims=True)
        covariances = np.einsum("nki,nkj->nij", spread, spread)
        axes[rows] = np.linalg.eigh(covariances)[1][:, :, 0]
    largest = np.abs(axes).argmax(axis=1)[:, None]
    return axes * np.sign(np.take_along_axis(axes, largest, axis=1))


def outward_signs(
    points: NDArray[np.float64],
    axes: NDArray[np.float64],
    caster: RayCaster,
    spacing: float,
) -> Steps[NDArray[np.float64]]:
    """Return 1 where an axis points outwards and -1 where inwards, (N,).

    More rays escape to the outside than through the inside; neighbors agree, the more
    the smaller the angle between their planes. Both are weighed in one system of linear
    equations, which carries signs over the graph of neighbors.

    Parameters
    ----------
    points, axes : (N, 3) float
        Normals up to their sign.
    caster : RayCaster
        Of the splats of these points, or of near ones.
    spacing : float
        Between points.
    """
    votes = np.zeros(len(points))
    for side in (1.0, -1.0):
        escapes = yield from _escapes(points, side * axes, caster, spacing)
        votes += side * escapes
    nearest = cKDTree(points).query(points, min(_NEIGHBORS, len(points)))[1][:, 1:]
    one, other = np.repeat(np.arange(len(points)), nearest.shape[1]), nearest.ravel()
    cosines = (axes[one] * axes[other]).sum(axis=1)
    weights = np.sign(cosines) * np.abs(cosines) ** _SHARPNESS
    ties = sparse.coo_array((weights, (one, other)), shape=(len(points),) * 2).tocsr()
    ties = (ties + ties.T) / 2
    degrees = np.asarray(abs(ties).sum(axis=1)).ravel()
    system = sparse.diags_array(1.0 + _AGREEMENT * degrees) - _AGREEMENT * ties
    beliefs, _ = cg(system, votes, rtol=1e-6, maxiter=1000)
    return np.where(beliefs < 0, -1.0, 1.0)


def _escapes(
    points: NDArray[np.float64],
    directions: NDArray[np.float64],
    caster: RayCaster,
    spacing: float,
) -> Steps[NDArray[np.float64]]:
    """Return the share of rays about each direction that meet nothing, (N,)."""
    rays = cone_directions(-directions, _RAYS, _CONE).reshape(-1, 3)
    starts = np.repeat(points + _START * spacing * directions, _RAYS, axis=0)
    met = np.empty(len(rays), dtype=bool)
    for start in range(0, len(rays), RAYS_PER_STEP):
        yield Progress("Normals", start / len(rays))
        step = slice(start, start + RAYS_PER_STEP)
        reach = np.full(len(rays[step]), _FAR)
        met[step] = caster.first_hit(starts[step], rays[step], reach)[0] >= 0
    return 1.0 - met.reshape(-1, _RAYS).mean(axis=1)
