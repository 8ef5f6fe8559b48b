"""Outward normals of point clouds: estimated, or checked for their side."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..steps.arrays import FloatArray
from ..steps.one_thread import on_one_thread
from ..steps.progress import Steps, within
from .jets import jet_normals
from .outward import outward_directions
from .splats import areas_of_points, noise_of, normal_weight, thinned_splats

# Nearest points that a jet is fitted to: the least, the most, and the most as a share
# of the cloud. More points average out noise, fewer resolve thin limbs, which have
# few points in a small cloud.
_FEWEST, _MOST, _MOST_OF_ALL = 10, 54, 0.02
# Points that a jet is fitted to, per unit of `noise_of`.
_FOR_NOISE = 100.0
# Least and greatest blur of the winding numbers, in distances of points.
_LEAST_BLUR, _MOST_BLUR = 0.35, 1.2
# Blur per unit of `noise_of`.
_BLUR_OF_NOISE = 2.25
# Sine of the assumed error of normals, per unit of `noise_of`. Lines of sight that
# graze a noisy board need it. A larger value treats creases as flat.
_TILT_OF_NOISE = 0.15
# Normals face inwards if the inward flux through the surface exceeds this share of the
# greatest possible flux.
_CLEARLY_INWARDS = 0.05
# Added to that share, times the missing share of the surface.
_FOR_MISSING = 0.25
# Points that given normals are compared with the surface at, at most, and the nearest
# points that show the surface there, with the point itself.
_PROBES, _NEAREST = 1000, 10
# Such points show a surface if they are at most this thick, in their width.
_FLAT = 0.25
# Normals are wrong if the median cosine between them and those of the surface is less,
# whichever side they face: 1/2 if they have nothing to do with it.
_LEAST_COSINE = 0.7
# And if more neighbors, as a share, face the opposite way, with a cosine below this,
# but lie above, by a height in diagonals: 1/4 if sides were chosen at random. The other
# side of a wall, however thin, lies below.
_MOST_OPPOSITE, _OPPOSITE, _ABOVE = 0.15, -0.5, 1e-6


@on_one_thread
def estimate_normals(points: FloatArray) -> Steps[tuple[FloatArray, float]]:
    """Estimate the outward normals of a point cloud, and their error.

    Winding numbers of the whole shape first tell the two sides of walls and thin limbs
    apart. Jets through the nearest points of one side then give more exact normals. The
    more noise there is, the more points a jet is fitted to.

    Parameters
    ----------
    points : (N, 3) float
        Centered at the origin.

    Returns
    -------
    normals : (N, 3) float
        Outward unit vectors.
    tilt : float
        Sine of the angle by which the normals may be off.
    """
    # The density of points does not depend on normals, so any normals will do.
    kept, _, _ = thinned_splats(points, np.broadcast_to(np.eye(3)[2], points.shape))
    few = points[kept]
    noise = noise_of(few)
    noise_of_all = noise if len(few) == len(points) else noise_of(points)
    clean = _FOR_NOISE * noise_of_all <= _FEWEST
    fitted = points if clean else few
    weight = normal_weight(fitted)
    blur = float(np.clip(_BLUR_OF_NOISE * noise, _LEAST_BLUR, _MOST_BLUR))
    outward = yield from within(outward_directions(few, blur), 0.0, 0.7)
    _, nearest = cKDTree(few).query(points)
    if clean:
        outward, nearest = outward[nearest], np.arange(len(points))
    most = max(min(_MOST, int(_MOST_OF_ALL * len(fitted))), _FEWEST)
    n_neighbors = int(np.clip(_FOR_NOISE * noise, _FEWEST, most))
    jets = jet_normals(fitted, outward, weight, n_neighbors)
    normals = yield from within(jets, 0.7, 1.0)
    return normals[nearest], _TILT_OF_NOISE * noise


def face_inwards(points: FloatArray, normals: FloatArray) -> bool:
    """Return whether normals point into the volume that the points enclose.

    The more of an open surface is missing, the less certain is the volume it encloses.
    In doubt it counts as facing outwards, since a single scan may show the hollow side
    of a bent board.

    Parameters
    ----------
    points, normals : (N, 3) float
        Normals are unit vectors.

    Returns
    -------
    bool
    """
    areas = areas_of_points(points, normals)
    arms = points - np.average(points, axis=0, weights=areas)
    fluxes = np.einsum("nd,nd->n", arms, normals)
    size = areas @ np.linalg.norm(arms, axis=1)
    # The area vectors of a closed surface sum to zero.
    missing = np.linalg.norm(areas @ normals) / areas.sum()
    return bool(areas @ fluxes < -(_CLEARLY_INWARDS + _FOR_MISSING * missing) * size)


def seem_wrong(points: FloatArray, normals: FloatArray) -> bool:
    """Return whether normals clearly disagree with the points, or with each other.

    Where neighbors do not show a surface, as in much noise, nothing is clear.

    Parameters
    ----------
    points, normals : (N, 3) float
        Where the diagonal of the bounding box is 1. Normals are unit vectors.

    Returns
    -------
    bool
    """
    rows = slice(None, None, -(-len(points) // _PROBES))
    _, nearest = cKDTree(points).query(points[rows], min(_NEAREST, len(points)))
    near = points[nearest]
    spread = near - near.mean(axis=1, keepdims=True)
    variances, axes = np.linalg.eigh(np.einsum("nki,nkj->nij", spread, spread))
    flat = variances[:, 0] <= _FLAT**2 * variances[:, 1]
    if 2 * flat.sum() < len(flat):
        return False
    cosines = np.einsum("nd,nd->n", axes[flat, :, 0], normals[rows][flat])
    unrelated = np.median(np.abs(cosines)) < _LEAST_COSINE
    own = normals[rows][:, :, None]
    opposite = (normals[nearest] @ own)[:, 1:] < _OPPOSITE
    above = ((near - points[rows][:, None]) @ own)[:, 1:] > _ABOVE
    return bool(unrelated or (opposite & above).mean() > _MOST_OPPOSITE)
