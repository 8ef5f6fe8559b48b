"""Keep the figures that panels draw, until the mesh changes.

Panels are drawn many times a second. In the background nothing is kept.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any, TypeAlias

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.errors import DecompositionError
from ..bridge.mesh.by_label import sums_of_all
from ..bridge.mesh.fingerprint import fits, together
from ..bridge.parts.figures import PartFigures, figures_of
from ..bridge.refusals import WORKED_ON
from ..bridge.stored.names import RESULT
from ..running.watching import unwatch, watch

# Seconds for which figures are kept in any case, for faces may be dragged in Edit Mode;
# and for how many times as long as counting them took.
_PAUSE = 0.3
_REST = 4.0
# The figures of an object's parts, and the fingerprint of all of its faces.
_Counted: TypeAlias = tuple[PartFigures | None, NDArray[np.float64] | None]
# Of the object drawn last: what it was, until when it is kept, and what was found.
_kept: tuple[tuple[object, ...], float, _Counted] | None = None
_changed = True


def shown_figures(obj: bpy.types.Object | None) -> PartFigures | None:
    """Return the figures of an object's parts, None if it has none to show."""
    return _counted(obj)[0]


def is_of_now(obj: bpy.types.Object, noted: Mapping[str, Any]) -> bool:
    """Return whether figures that are noted of an object are of its present faces."""
    now = _counted(obj)[1]
    return now is not None and fits(noted, now)


def _counted(obj: bpy.types.Object | None) -> _Counted:
    """Return what was kept of an object; count if it may have changed."""
    global _kept, _changed
    if obj is None or obj.type not in WORKED_ON:
        return None, None
    state = obj.session_uid, obj.data.session_uid, obj.mode, obj.get(RESULT)
    now = time.perf_counter()
    if _kept is not None and _kept[0] == state and not bpy.app.background:
        until, latest = _kept[1:]
        if not _changed or now < until:
            return latest
    counted, ended = _count(obj), time.perf_counter()
    until = ended + max(_PAUSE, _REST * (ended - now))
    _kept, _changed = (state, until, counted), False
    return counted


def _count(obj: bpy.types.Object) -> _Counted:
    """Count the faces of an object and of its parts; read no mesh without a result."""
    try:
        figures = figures_of(obj)
    except DecompositionError:  # a property of the user's
        figures = None
    if figures is not None:
        return figures, together(figures.measured_on)
    return None, sums_of_all(obj) if RESULT in obj else None


@bpy.app.handlers.persistent
def _forget(*_: object) -> None:
    """Count again when something changes. Blender passes arguments to handlers."""
    global _changed
    _changed = True


_HANDLERS = dict.fromkeys(
    ("depsgraph_update_post", "undo_post", "redo_post", "load_post"), _forget
)


def register() -> None:
    """Watch for changes."""
    watch(_HANDLERS)


def unregister() -> None:
    """Undo `register`, and forget all figures."""
    global _kept
    unwatch(_HANDLERS)
    _kept = None
