"""Hulls of large meshes are built in another process, so that a window stays alive.

Single steps on a large mesh take longer than a window may stand still. Another process
takes a second to start, so hulls of small meshes are built here.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from .... import core
from ....core.geometry.mesh import TriangleMesh
from ....core.geometry.shape import Shape
from ....core.results.hulls import HullDecomposition
from ....core.steps.processes import Processes
from ....core.steps.progress import Steps
from .session_cache import session_cache

# With more triangles, single steps may take over 0.1 s.
_MANY = 10_000


def hulls_around(
    shape: Shape, compute: Callable[..., Steps[HullDecomposition]], in_window: bool
) -> Steps[HullDecomposition]:
    """Return the steps that build hulls around a shape, here or in another process.

    Parameters
    ----------
    shape : Shape
    compute : callable
        Takes the argument `cache`, and returns steps. Can be pickled.
    in_window : bool
        Whether the steps run in a window, which must stay alive.
    """
    is_large = isinstance(shape, TriangleMesh) and len(shape.triangles) > _MANY
    if not (in_window and is_large):
        return (yield from compute(cache=session_cache()))
    elsewhere = partial(compute, cache=core.ShapeCache(core.no_rays))
    apart = Processes(1)
    try:
        return (yield from apart.steps("Solid", elsewhere))
    finally:
        apart.close()
