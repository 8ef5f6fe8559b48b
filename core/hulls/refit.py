"""Fit another shape around one piece of a solid, and measure it."""

from __future__ import annotations

import numpy as np

from ..cache import ShapeCache
from ..geometry.mesh import TriangleMesh
from ..parameters.hulls import HullParameters
from ..results.hulls import HullDecomposition
from ..steps.arrays import FloatArray
from ..steps.progress import Progress, Steps, within
from .convex_hull import THIN, convex_hull
from .convex_solid import exact_error, has_volume_of, hull_of_convex
from .fitting import fit_for
from .measure.error_bound import ErrorBound
from .solid import solid_of


def refit_in_steps(
    mesh: TriangleMesh,
    points: FloatArray,
    parameters: HullParameters,
    cache: ShapeCache,
    scene_unit: float = 1.0,
) -> Steps[HullDecomposition]:
    """Fit a shape around a piece, and state its error as for the shapes of all pieces.

    Parameters
    ----------
    mesh : TriangleMesh
        The whole.
    points : (N, 3) float
        Points with the same convex hull as the piece.
    parameters : HullParameters
    cache : ShapeCache
    scene_unit : float
        Length in the scene of 1 in the units of the mesh.

    Returns
    -------
    Steps of HullDecomposition
        With one shape, and a volume ratio of that alone.
    """
    prepared = yield from within(cache.prepare(mesh), 0.0, 0.1)
    fit, factor = fit_for(mesh, parameters, scene_unit)
    scale = mesh.diagonal / fit.unit
    solid = yield from within(solid_of(prepared.solid, 0, scale), 0.1, 0.8)
    yield Progress("Measuring", 0.8)
    hull = convex_hull((points - mesh.center) / fit.unit, THIN)
    shape = fit.shape(hull)
    error = None
    if prepared.convex and has_volume_of(hull, hull_of_convex(prepared, scale)):
        error = exact_error(shape, hull, fit)
    if error is None:
        error = ErrorBound(solid, shape, hull, fit.max_error).value
    volume = solid.true_volume
    ratio = shape.volume / volume if volume > 0 else np.inf
    return HullDecomposition(
        (shape.moved(fit.unit, mesh.center),),
        np.array([error * factor]),
        np.array([-1]),
        ratio,
        prepared.notes,
        parameters.error_unit,
        fit.unit * scene_unit,
    )
