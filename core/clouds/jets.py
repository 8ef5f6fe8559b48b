"""Normals from jets: quadratic surfaces fitted to the neighbors of each point."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..geometry.frames import frames, unit
from ..steps.progress import Progress, Steps
from .splats import placed, spacing_of

# Most points at which noise is measured.
_PROBES = 1000
# Points in each neighborhood that noise is measured in, with the point itself.
_NEAREST = 10
# Quantile of the measured noise that is used: neighborhoods at edges are thick
# without noise.
_FLATTEST = 0.2
# Least factor of the weight of points that face elsewhere. Most of them are beyond an
# edge.
_LEAST_WEIGHT = 0.01
# Regularization of the quadratic terms, as a share of the total weight: few points do
# not determine them.
_STIFFNESS = 1e-2
# Regularization of all terms.
_LEAST = 1e-6
# Jets fitted in one step.
_FITS_PER_STEP = 2**12


def noise_of(points: NDArray[np.float64]) -> float:
    """Return the noise of a cloud: thickness of small neighborhoods over their width.

    It is 0 where points lie exactly in planes, and somewhat above 0.5 where they fill a
    volume.

    Parameters
    ----------
    points : (N, 3) float

    Returns
    -------
    float
        A ratio, without unit.
    """
    probes = points[:: -(-len(points) // _PROBES)]
    _, nearest = cKDTree(points).query(probes, min(_NEAREST, len(points)))
    near = points[nearest]
    spread = near - near.mean(axis=1, keepdims=True)
    variances = np.linalg.eigvalsh(np.einsum("nki,nkj->nij", spread, spread))
    variances = np.maximum(variances, np.finfo(float).tiny)
    thickness = np.sqrt(variances[:, 0] / variances[:, 1])
    return float(np.quantile(thickness, _FLATTEST))


def jet_normals(
    points: NDArray[np.float64], normals: NDArray[np.float64], n_neighbors: int
) -> Steps[NDArray[np.float64]]:
    """Return the normals of jets fitted to the nearest points of each point.

    A jet is a height above the plane at right angles to the rough normal, quadratic in
    the two coordinates of that plane. Near points weigh more. Points on the other side
    of a thin wall weigh very little.

    Parameters
    ----------
    points : (N, 3) float
    normals : (N, 3) float
        Rough normals, unit vectors.
    n_neighbors : int
        Points that each jet is fitted to, with the point itself.

    Returns
    -------
    Steps of (N, 3) float
        Unit vectors.

    References
    ----------
    Cazals and Pouget, "Estimating differential quantities using polynomial fitting of
    osculating jets", 2003.
    """
    places = placed(points, normals, spacing_of(points))
    tree, found = cKDTree(places), []
    for start in range(0, len(points), _FITS_PER_STEP):
        yield Progress("Normals", start / len(points))
        rows = slice(start, start + _FITS_PER_STEP)
        _, nearest = tree.query(places[rows], min(n_neighbors, len(points)))
        offsets = points[nearest] - points[rows, None]
        cosines = np.einsum("nkd,nd->nk", normals[nearest], normals[rows])
        found.append(_jets(offsets, cosines, normals[rows]))
    return np.concatenate(found)


def _jets(
    offsets: NDArray[np.float64],
    cosines: NDArray[np.float64],
    normals: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return normals (N, 3) of jets through neighbors at `offsets` (N, k, 3).

    `cosines` (N, k) are those between the normals of neighbors and `normals` (N, 3).
    """
    tangents, bitangents = frames(normals)
    axes = np.stack([tangents, bitangents, normals], axis=2)
    across, along, heights = np.moveaxis(offsets @ axes, 2, 0)
    widths = np.sqrt((across**2 + along**2).mean(axis=1, keepdims=True))
    widths = np.maximum(widths, np.finfo(float).tiny)
    across, along, heights = across / widths, along / widths, heights / widths
    weights = np.exp(-(across**2 + along**2) / 2) * np.clip(cosines, _LEAST_WEIGHT, 1.0)
    ones = np.ones_like(across)
    terms = np.stack([ones, across, along, across**2, across * along, along**2], axis=1)
    weighted = weights[:, None] * terms
    squares = weighted @ terms.transpose(0, 2, 1)
    stiff = _STIFFNESS * np.diag([0.0, 0.0, 0.0, 1.0, 1.0, 1.0])
    squares += weights.sum(axis=1)[:, None, None] * stiff + _LEAST * np.eye(6)
    jets = np.linalg.solve(squares, weighted @ heights[:, :, None])
    return unit(normals - jets[:, 1] * tangents - jets[:, 2] * bitangents)
