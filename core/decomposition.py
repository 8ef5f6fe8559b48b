"""The paper's algorithm, one line per stage."""

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

# Share of the time after which a stage ends: surface, lines of sight, parts. With
# further levels these are but the beginning.
_ONE_LEVEL = (0.02, 0.8, 1.0)
_LEVELS = (0.01, 0.15, 0.25)


def decompose_in_steps(
    shape: Shape,
    parameters: Parameters,
    cache: ShapeCache,
    members: NDArray[np.bool_] | None = None,
) -> Steps[Decomposition]:
    """Split a shape, or some of its faces, into weakly convex parts.

    Asafi, Goren and Cohen-Or 2013, "Weak Convex Decomposition by Lines-of-sight".

    Parameters
    ----------
    shape : TriangleMesh or PointCloud
        In any units. It may be open, in several pieces or not manifold.
    parameters : Parameters
    cache : ShapeCache
        Keeps what is worth it for the next call.
    members : (P,) bool, optional
        Split these polygons, or points, alone. All samples then lie on them, so that
        details such as fingers are seen. Rays still run through the whole shape.

    Returns
    -------
    Steps of Decomposition
        Of all polygons or points, or of the members in their order. It yields
        `Progress`; `run` returns its value.

    Raises
    ------
    DecompositionError
        If the surface has no area, or if faces are the samples and there are too many.
    """
    ready, seen, done = _ONE_LEVEL if parameters.levels == 1 else _LEVELS
    # Section 5: points become splats, faces turn outwards, shells are found.
    prepared = yield from within(cache.prepare(shape), 0.0, ready)
    if members is not None:
        prepared = prepared.part(members)
    # Sections 3 and 5: samples, and the matrix of their lines of sight (eq. 3).
    memo = yield from within(cache.see(prepared, parameters), ready, seen)
    # Section 4: embedding, clusters, the number of parts by psi (eq. 5), seams (eq. 4).
    found = yield from within(find_parts(memo, parameters), seen, done)
    if parameters.levels == 1:
        return found
    # Section 5: parts are partitioned further.
    again = split_again(prepared, memo.visibility, found, parameters)
    return (yield from within(again, done, 1.0))
