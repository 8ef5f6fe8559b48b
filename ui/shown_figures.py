"""Keep the figures that panels draw, until the mesh changes.

Panels are drawn many times a second. In the background nothing is kept.
"""

from __future__ import annotations

import time

import bpy

from ..core.errors import DecompositionError
from ..operators.bridge.parts.figures import PartFigures, figures_of
from ..operators.bridge.refusals import WORKED_ON
from ..operators.bridge.stored.names import RESULT

# Seconds for which figures are kept in any case: faces may be dragged in Edit Mode.
_PAUSE = 0.3
# Of the object drawn last: what it was, when it was counted, and its figures.
_kept: tuple[tuple[object, ...], float, PartFigures | None] | None = None
_changed = True


def shown_figures(obj: bpy.types.Object | None) -> PartFigures | None:
    """Return the figures of an object's parts, None if it has none to show."""
    global _kept, _changed
    if obj is None or obj.type not in WORKED_ON:
        return None
    state = obj.session_uid, obj.data.session_uid, obj.mode, obj.get(RESULT)
    now = time.perf_counter()
    if _kept is not None and _kept[0] == state and not bpy.app.background:
        before, latest = _kept[1:]
        if not _changed or now < before + _PAUSE:
            return latest
    try:
        figures = figures_of(obj)
    except DecompositionError:  # a property of the user's
        figures = None
    _kept, _changed = (state, now, figures), False
    return figures


@bpy.app.handlers.persistent
def _forget(*_: object) -> None:
    """Count again when something changes. Blender passes arguments to handlers."""
    global _changed
    _changed = True


_HANDLERS = ("depsgraph_update_post", "undo_post", "redo_post", "load_post")


def register() -> None:
    """Watch for changes."""
    for name in _HANDLERS:
        getattr(bpy.app.handlers, name).append(_forget)


def unregister() -> None:
    """Undo `register`, and forget all figures."""
    global _kept
    for name in _HANDLERS:
        getattr(bpy.app.handlers, name).remove(_forget)
    _kept = None
