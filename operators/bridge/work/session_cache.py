"""The one cache of the session: new parts of the same shape take a moment.

It is the one state of the extension that outlives an operator. It holds arrays and no
data of Blender's, and it knows shapes by content, so that no change goes unnoticed.
"""

from __future__ import annotations

import bpy

from .... import core
from ....core.geometry.shape import Shape
from ....core.parameters.parts import Parameters
from ..rays.bvh import BvhRayCaster

_cache: core.ShapeCache | None = None


def session_cache() -> core.ShapeCache:
    """Return the cache. It is made at the first call, as it loads SciPy."""
    global _cache
    if _cache is None:
        _cache = core.ShapeCache(BvhRayCaster)
    return _cache


def has_seen(shape: Shape, parameters: Parameters) -> bool:
    """Return whether the lines of sight of a shape are known already."""
    return _cache is not None and _cache.has_seen(shape, parameters)


@bpy.app.handlers.persistent
def forget(*_: object) -> None:
    """Free the memory."""
    global _cache
    _cache = None


def register() -> None:
    """Forget at each file load."""
    bpy.app.handlers.load_pre.append(forget)


def unregister() -> None:
    """Undo `register`, and forget."""
    bpy.app.handlers.load_pre.remove(forget)
    forget()
