"""Normals of point clouds: estimated where there are none, and turned outwards."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..steps.progress import Steps, within
from .jets import jet_normals, noise_of
from .splats import areas_of_points, thinned_splats
from .winding import outward_directions

# Nearest points that a jet is fitted to: more average noise, fewer see thin limbs, of
# which a cloud of few points has not many.
_FEWEST, _MOST, _MOST_OF_ALL = 10, 54, 0.02
_FOR_NOISE = 100.0
# How wide points are for the whole shape, in their distances.
_LEAST_BLUR, _MOST_BLUR = 0.35, 1.2
_BLUR_OF_NOISE = 2.25
# Sine of the angle that is allowed for, where lines of sight graze a noisy board; more
# of it takes creases for flat.
_TILT_OF_NOISE = 0.15
# A flux through the surface below this share of the greatest one is an inward one, and
# what is added to that share for each share of the surface that is missing.
_CLEARLY_INWARDS = 0.05
_FOR_MISSING = 0.25


def estimate_normals(
    points: NDArray[np.float64],
) -> Steps[tuple[NDArray[np.float64], float]]:
    """Estimate which way is out at points, and how exact that is.

    What makes a closed shape of the whole tells the two sides of walls and thin limbs
    apart. Jets through the nearest points of one side are more exact; the more noise
    there is, the more points they are fitted to.

    Parameters
    ----------
    points : (N, 3) float
        Around the origin.

    Returns
    -------
    normals : (N, 3) float
        Outward unit vectors.
    tilt : float
        Sine of the angle by which they may be off.
    """
    # Which way points face does not matter to how densely they lie.
    kept, _, _ = thinned_splats(points, np.broadcast_to(np.eye(3)[2], points.shape))
    few = points[kept]
    noise = noise_of(few)
    blur = float(np.clip(_BLUR_OF_NOISE * noise, _LEAST_BLUR, _MOST_BLUR))
    outward = yield from within(outward_directions(few, blur), 0.0, 0.7)
    _, nearest = cKDTree(few).query(points)
    if _FOR_NOISE * noise_of(points) <= _FEWEST:
        few, outward, nearest = points, outward[nearest], np.arange(len(points))
    most = max(min(_MOST, int(_MOST_OF_ALL * len(few))), _FEWEST)
    n_neighbors = int(np.clip(_FOR_NOISE * noise, _FEWEST, most))
    jets = jet_normals(few, outward, n_neighbors)
    normals = yield from within(jets, 0.7, 1.0)
    return normals[nearest], _TILT_OF_NOISE * noise


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
