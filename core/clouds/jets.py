"""Normals from jets: quadratic surfaces fitted to the neighbors of each point."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..geometry.frames import frames, unit, with_normals
from ..steps.arrays import FloatArray
from ..steps.progress import Progress, Steps

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


def jet_normals(
    points: FloatArray, normals: FloatArray, weight: float, n_neighbors: int
) -> Steps[FloatArray]:
    """Return the normals of jets fitted to the nearest points of each point.

    A jet is a height above the plane at right angles to the rough normal, quadratic in
    the two coordinates of that plane. Near points weigh more. Points on the other side
    of a thin wall weigh very little.

    Parameters
    ----------
    points : (N, 3) float
    normals : (N, 3) float
        Rough normals, unit vectors.
    weight : float
        Distance that normals one unit apart add, from `normal_weight`.
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
    places = with_normals(points, normals, weight)
    tree, found = cKDTree(places), []
    for start in range(0, len(points), _FITS_PER_STEP):
        yield Progress("Normals", start / len(points))
        rows = slice(start, start + _FITS_PER_STEP)
        _, nearest = tree.query(places[rows], min(n_neighbors, len(points)))
        offsets = points[nearest] - points[rows, None]
        cosines = np.einsum("nkd,nd->nk", normals[nearest], normals[rows])
        found.append(_jets(offsets, cosines, normals[rows]))
    return np.concatenate(found)


def _jets(offsets: FloatArray, cosines: FloatArray, normals: FloatArray) -> FloatArray:
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
