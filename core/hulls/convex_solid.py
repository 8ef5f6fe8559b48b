"""Collision shapes around convex solids, whose errors are known without measuring."""

from __future__ import annotations

import numpy as np

from ..geometry.primitives import CollisionShape, Hull
from ..sight.prepared import PreparedShape
from .convex_hull import THIN, convex_hull
from .fitting import Fit
from .measure.uncovered import uncovered

# Shapes whose volumes differ by less, as a share, are the same if one is in the other.
_SAME_VOLUME = 1e-9


def hull_of_convex(prepared: PreparedShape, scale: float) -> Hull:
    """Return a convex solid as a hull.

    Parameters
    ----------
    prepared : PreparedShape
    scale : float
        Makes its longest side 2.

    Returns
    -------
    Hull
    """
    mesh = prepared.solid
    used = np.unique(mesh.triangles)  # other vertices are in no face
    return convex_hull(mesh.vertices[used] * scale, THIN)


def exact_error(shape: CollisionShape, solid: Hull, fit: Fit) -> float | None:
    """Return the error of a shape around a convex solid, None if it must be measured.

    A shape as large as the solid is the solid. A hull within the solid adds nothing:
    its error is what it leaves uncovered.

    Parameters
    ----------
    shape : CollisionShape
    solid : Hull
    fit : Fit
        The shape was fitted with.

    Returns
    -------
    float or None
    """
    error = uncovered(shape, solid)
    within = shape.kind == "HULL" and fit.margin <= 0
    same = has_volume_of(shape, solid) and error <= THIN
    return error if within or same else None


def has_volume_of(shape: CollisionShape | Hull, solid: Hull) -> bool:
    """Return whether a shape has the volume of a solid, but for rounding.

    Parameters
    ----------
    shape : CollisionShape or Hull
    solid : Hull
    """
    return abs(shape.volume - solid.volume) <= _SAME_VOLUME * solid.volume
