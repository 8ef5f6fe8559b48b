"""Keep the figures that panels draw, until the mesh changes.

Panels are drawn many times a second. What is not counted at once is counted, and drawn,
a moment later. In the background nothing is kept.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import bpy

from ...core.errors import DecompositionError
from ...core.steps.arrays import FloatArray
from ..bridge.mesh.by_label import sums_of_all
from ..bridge.mesh.fingerprint import fits, together
from ..bridge.parts.figures import PartFigures, figures_of
from ..bridge.refusals import WORKED_ON
from ..bridge.stored.names import RESULT
from ..bridge.watching import REPLACED, changed_objects, start_timer, stop_timer
from .viewports import redraw

# Seconds for which figures are kept in any case, for faces may be dragged in Edit Mode;
# and for how many times as long as counting them took.
_PAUSE = 0.3
_REST = 4.0
# Meshes of more faces are counted in Edit Mode once they have been left alone for so
# many seconds: that takes longer than a drawing may.
_MANY = 50_000
_LULL = 0.5
# The figures of an object's parts, and the fingerprint of all of its faces.
_Counted: TypeAlias = tuple[PartFigures | None, FloatArray | None]


@dataclass
class _Kept:
    """The figures of an object: what it was, and until when they are kept."""

    state: tuple[object, ...]
    mode: str
    until: float
    counted: _Counted
    changed: float | None = None  # when its faces changed last, None if they did not


_kept: _Kept | None = None  # of the object drawn last


def shown_figures(obj: bpy.types.Object | None) -> PartFigures | None:
    """Return the figures of an object's parts, None if it has none to show."""
    return _counted(obj)[0]


def is_of_now(obj: bpy.types.Object, noted: Mapping[str, Any]) -> bool:
    """Return whether figures that are noted of an object are of its present faces."""
    now = _counted(obj)[1]
    return now is not None and fits(noted, now)


def _counted(obj: bpy.types.Object | None) -> _Counted:
    """Return what was kept of an object; count if it may have changed."""
    global _kept
    if obj is None or obj.type not in WORKED_ON:
        return None, None
    state = obj.session_uid, obj.data.session_uid, obj.get(RESULT)
    now = time.perf_counter()
    if _kept is not None and _kept.state == state and not bpy.app.background:
        wait = _due(_kept, obj) - now
        if wait > 0.0:
            # Panels that are drawn again count what has changed.
            if wait < math.inf:
                start_timer(redraw, wait)
            return _kept.counted
    counted, ended = _count(obj), time.perf_counter()
    until = ended + max(_PAUSE, _REST * (ended - now))
    _kept = _Kept(state, obj.mode, until, counted)
    return counted


def _due(kept: _Kept, obj: bpy.types.Object) -> float:
    """Return when an object is counted again; at infinity if it has not changed."""
    same_mode = obj.mode == kept.mode
    if kept.changed is None and same_mode:
        return math.inf
    if obj.mode == "EDIT" and len(obj.data.polygons) > _MANY:
        return max(kept.until, (kept.changed or 0.0) + _LULL)
    return kept.until if same_mode else 0.0


def _count(obj: bpy.types.Object) -> _Counted:
    """Count the faces of an object and of its parts; read no mesh without a result."""
    try:
        figures = figures_of(obj)
    except DecompositionError:  # a property of the user's
        figures = None
    if figures is not None:
        return figures, together(figures.measured_on)
    return None, sums_of_all(obj) if RESULT in obj else None


def _forget(*_: object) -> None:
    """Count again when anything may change. Blender passes arguments to handlers."""
    if _kept is not None:
        _kept.changed = time.perf_counter()


def _forget_changed(_: bpy.types.Scene, graph: bpy.types.Depsgraph) -> None:
    """Count again when the faces of the object drawn last change."""
    if _kept is None:
        return
    uid = _kept.state[0]
    if any(each.session_uid == uid for each in changed_objects(graph)):
        _forget()


def stop() -> None:
    """Forget all figures."""
    global _kept
    stop_timer(redraw)
    _kept = None


HANDLERS = {
    "depsgraph_update_post": _forget_changed,
    **dict.fromkeys(REPLACED, _forget),
}
