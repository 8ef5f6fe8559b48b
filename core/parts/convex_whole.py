"""The decomposition of a convex shape, which is known without lines of sight."""

from __future__ import annotations

import numpy as np

from ..parameters.parts import Parameters
from ..results.parts import Decomposition
from ..sight.prepared import PreparedShape


def stays_whole(shape: PreparedShape, parameters: Parameters) -> bool:
    """Return whether a shape is one part, as is known without lines of sight.

    All points of a convex shape see each other, so that psi of one part is 1 (eq. 5).
    No other parts reach that.

    Parameters
    ----------
    shape : PreparedShape
    parameters : Parameters
        If they ask for a number of parts, or for more levels, parts are searched for.

    Returns
    -------
    bool
    """
    searches = parameters.parts > 1 or parameters.levels > 1
    # With more than the usual fewest, the user wants to hear of what was tried.
    searches |= parameters.min_parts > Parameters.min_parts
    return shape.convex and not searches


def as_one_part(shape: PreparedShape) -> Decomposition:
    """Return the decomposition of a convex shape: one part of rank and psi 1.

    Parameters
    ----------
    shape : PreparedShape
        A convex mesh.

    Returns
    -------
    Decomposition
        One number of parts is in `psi_by_k`: no other was tried.
    """
    area = float(shape.targets.areas.sum()) * shape.diagonal**2
    return Decomposition(
        labels=np.zeros(len(shape.nodes), dtype=np.int64),
        areas=np.array([area]),
        ranks=np.ones(1),
        psi_before=1.0,
        psi=1.0,
        psi_by_k={1: 1.0},
        best_k=1,
        notes=shape.notes,
    )
