"""One part of a shape decomposed again, from samples of its own."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .decomposition import Decomposition, find_parts
from .form import Shape
from .parameters import Parameters
from .progress import Steps, within
from .scene import MakeCaster
from .visibility import see


def split_part(
    shape: Shape,
    members: NDArray[np.bool_],
    parameters: Parameters,
    make_caster: MakeCaster,
) -> Steps[Decomposition]:
    """Split some faces of `shape`, as if no others were to be decomposed.

    All samples lie on these faces, so that what is small in the whole shape, such as
    fingers, is seen; lines of sight run through the whole shape.

    Parameters
    ----------
    shape : TriangleMesh or PointCloud
    members : (P,) bool
        Polygons, or points, of the part.
    parameters : Parameters
        Numbers of parts and shares of the area are those of the part alone.
    make_caster : callable
        As in `visibility.look`, whose errors are raised.

    Returns
    -------
    Steps of Decomposition
        Of the members in their order.
    """
    looked = see(shape, parameters, make_caster, members)
    visibility = yield from within(looked, 0.0, 0.8)
    return (yield from within(find_parts(visibility, parameters), 0.8, 1.0))
