"""Surfaces of second order, jets, fitted to the nearest points of each of a cloud."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..geometry.frames import frames, unit
from ..steps.progress import Progress, Steps
from .splats import placed, spacing_of

# Points that tell how much noise there is, and the nearest that each asks for it.
_PROBES = 1000
_NEAREST = 10
# Share of places that are flat: others may be at edges.
_FLATTEST = 0.2
# How little points count at least that face elsewhere: beyond an edge, mostly.
_LEAST_WEIGHT = 0.01
# What is added to squares of curvatures, and to all: few points do not settle them.
_STIFFNESS = 1e-2
_LEAST = 1e-6
# Points whose jets are fitted at a time.
_FITS_PER_STEP = 2**12


def noise_of(points: NDArray[np.float64]) -> float:
    """Return how far points are off their surface, in the width of the nearest few.

    From 0 to somewhat above 0.5, where points fill a volume.

    Parameters
    ----------
    points : (N, 3) float
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
    """Return normals (N, 3) of the jets through the points around each.

    A jet is a height above the plane that faces along the rough normal, quadratic in
    the two coordinates there (Cazals and Pouget 2003). Near points count more, those of
    another side of a thin wall hardly.

    Parameters
    ----------
    points : (N, 3) float
    normals : (N, 3) float
        Rough ones, unit vectors.
    n_neighbors : int
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
    """Return normals (N, 3) of jets through some points around each, (N, k, 3).

    `cosines` tell how these face, in comparison to `normals`.
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
