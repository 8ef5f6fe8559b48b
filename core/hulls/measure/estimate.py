"""A quick estimate of a collision shape's error, by which cuts are compared."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ...geometry.primitives import CollisionShape, Hull
from ...geometry.sampling import points_on
from ...steps.arrays import FloatArray
from ..outline import fine_outline
from ..solid import Solid

# Weight k of the volume term in CoACD's concavity.
_VOLUME_WEIGHT = 0.3
# Largest number of samples times planes of a hull for which heights are estimated.
_MOST_HEIGHTS = 500_000
# Number of samples on the surface of a shape for an estimate.
_SHAPE_SAMPLES = 400
# Subtracted from the distance between a point and the nearest sample, as a share of
# the spacing: even points on the surface lie between samples.
_SLACK = 0.4


def estimated_error(
    solid: Solid,
    shape: CollisionShape,
    hull: Hull,
    boundary: FloatArray,
    witnesses: FloatArray,
    least: float,
) -> float:
    """Estimate the error of a collision shape from samples.

    Parameters
    ----------
    solid : Solid
    shape : CollisionShape
    hull : Hull
        As for `ErrorBound`.
    boundary : (N, 3) float
        Samples of the surface of the piece, and of the faces that cuts made.
    witnesses : (W, 3) float
        Points that are surely outside the solid and far from its surface.
    least : float
        The terms of the error that are known: of volumes, and of depths.

    Returns
    -------
    float
    """
    if len(boundary) == 0:
        return least
    # Without a margin, it is the hull: of many vertices, which would take long.
    outside = 0.0 if shape.hull is hull else shape.heights(hull.vertices).max()
    # Building a balanced tree takes twice as long, and questions are few.
    places = np.concatenate([boundary, hull.vertices])
    tree = cKDTree(places, balanced_tree=False, compact_nodes=False)
    _, spread = points_on(
        fine_outline(shape)[0], _SHAPE_SAMPLES, np.random.default_rng(0)
    )
    if shape.kind != "HULL":  # it reaches into other pieces
        spread = spread[~solid.inside.holds(spread)]
    away = tree.query(spread)[0].max(initial=0.0) - _SLACK * solid.spacing
    if len(witnesses):
        beyond = np.maximum(shape.heights(witnesses), 0.0)
        away = max(away, float((tree.query(witnesses)[0] - 2 * beyond).max()))
    return float(max(least, outside, away))


def estimated_depth(shape: CollisionShape, boundary: FloatArray) -> float:
    """Return about how deep below the surface of a shape that of its piece is.

    Parameters
    ----------
    shape : CollisionShape
    boundary : (N, 3) float
        As for `estimated_error`.

    Returns
    -------
    float
    """
    n_heights = len(boundary) * len(shape.hull.planes)
    some = boundary[:: max(-(-n_heights // _MOST_HEIGHTS), 1)]
    return float(-shape.heights(some).min(initial=0.0))


def volume_error(volume: float) -> float:
    """Return the error R_v of CoACD, weight k included, of an added volume.

    Parameters
    ----------
    volume : float
        By noise, a convex piece may have more volume than its hull. That is no error.
    """
    return float(_VOLUME_WEIGHT * np.cbrt(3 * max(volume, 0.0) / (4 * np.pi)))
