"""The latest visibility, kept so that new parts of the same shape take a moment.

The one state of the extension that outlives an operator. It holds arrays, no data of
Blender's, and knows its shape by content: whatever changes a mesh, in whatever way, is
noticed.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import TYPE_CHECKING

import bpy

from ....core.parameters.parts import Parameters
from ....core.steps.progress import Steps
from ..rays.bvh import BvhRayCaster

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ....core.sight.prepared import Shape
    from ....core.sight.visibility import Visibility

_latest: dict[Hashable, Visibility] = {}


def see_once(shape: Shape, parameters: Parameters) -> Steps[Visibility]:
    """Return the visibility of a shape: the latest one if it is the same."""
    from ....core.sight.visibility import see
    from ....core.sight.visibility_key import visibility_key

    key = visibility_key(shape, parameters)
    if key not in _latest:
        visibility = yield from see(shape, parameters, BvhRayCaster)
        _latest.clear()
        _latest[key] = visibility
    return _latest[key]


def is_seen(shape: Shape, parameters: Parameters) -> bool:
    """Return whether the latest visibility is that of a shape."""
    if not _latest:  # nor are the libraries loaded
        return False
    from ....core.sight.visibility_key import visibility_key

    return visibility_key(shape, parameters) in _latest


@bpy.app.handlers.persistent
def forget(*_: object) -> None:
    """Free the memory."""
    _latest.clear()


def register() -> None:
    """Forget at each file load."""
    bpy.app.handlers.load_pre.append(forget)


def unregister() -> None:
    """Undo `register`, and forget."""
    bpy.app.handlers.load_pre.remove(forget)
    forget()
