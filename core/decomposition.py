"""The algorithm of the paper, one line for each stage."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .cache import ShapeCache
from .geometry.shape import Shape
from .parameters.parts import Parameters
from .parts.find import find_parts
from .parts.levels import split_again
from .results import Decomposition
from .steps.progress import Steps, within

# Progress at the end of the stages surface, lines of sight and parts. With further
# levels, these three are only the first quarter.
_ONE_LEVEL = (0.02, 0.8, 1.0)
_LEVELS = (0.01, 0.15, 0.25)


def decompose_in_steps(
    shape: Shape,
    parameters: Parameters,
    cache: ShapeCache,
    members: NDArray[np.bool_] | None = None,
) -> Steps[Decomposition]:
    """Split a shape, or some of its faces, into weakly convex parts.

    Parameters
    ----------
    shape : TriangleMesh or PointCloud
        In any units. It may be open, in several pieces or not manifold.
    parameters : Parameters
    cache : ShapeCache
        Keeps the prepared shape and its lines of sight for the next call.
    members : (P,) bool, optional
        Polygons, or points of a cloud, to split; all if left out. All samples lie on
        them, which shows details such as fingers. Rays run through the whole shape.

    Returns
    -------
    Steps of Decomposition
        Its labels are those of all polygons or points, or of the members in ascending
        order. The steps yield `Progress`; `run` returns the decomposition.

    Raises
    ------
    DecompositionError
        If the surface has no area, or if faces are the samples and there are too many.

    References
    ----------
    Asafi, Goren and Cohen-Or 2013, "Weak Convex Decomposition by Lines-of-sight".
    """
    ready, seen, done = _ONE_LEVEL if parameters.levels == 1 else _LEVELS
    # Section 5: replace points by splats, turn faces outwards, find shells.
    prepared = yield from within(cache.prepare(shape), 0.0, ready)
    if members is not None:
        prepared = prepared.part(members)
    # Sections 3 and 5: place samples, and fill the matrix of lines of sight (eq. 3).
    memo = yield from within(cache.see(prepared, parameters), ready, seen)
    # Section 4: embed and cluster the samples, choose the number of parts by psi
    # (eq. 5), cut the seams (eq. 4).
    found = yield from within(find_parts(memo, parameters), seen, done)
    if parameters.levels == 1:
        return found
    # Section 5: split the parts further.
    again = split_again(prepared, memo.visibility, found, parameters)
    return (yield from within(again, done, 1.0))
