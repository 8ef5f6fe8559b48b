"""Bring parts in step after a join while a modifier of ours shows them.

Exploded views and isolated parts go by the numbers on faces, which two parts can share
after a join. All else asks who the parts are, and waits for Refresh. This belongs to
the undo step of the join, so it is done again if undo brings that back.
"""

from __future__ import annotations

import bpy

from ...core.errors import DecompositionError
from ..bridge.views.node_modifiers import is_view
from ..bridge.watching import REPLACED, changed_objects, start_timer, stop_timer
from ..bridge.work.in_step import bring_in_step

# How many faces the objects with such modifiers have, by their `session_uid`.
_n_faces: dict[int, int] = {}


def bring_views_in_step() -> None:
    """Bring all objects in step whose parts a modifier of ours shows."""
    for obj in bpy.data.objects:
        if _is_viewed(obj):
            try:
                bring_in_step(obj)
            except DecompositionError:  # the buttons report it
                continue


def _is_viewed(obj: bpy.types.Object) -> bool:
    """Return whether such a modifier shows an object, in the mode of joins."""
    there = obj.type == "MESH" and obj.mode == "OBJECT"
    return there and any(map(is_view, obj.modifiers))


def _start() -> None:
    """Do it once whatever changes objects now has ended."""
    if bpy.app.background:  # nothing calls timers there
        bring_views_in_step()
    else:
        start_timer(bring_views_in_step)


def _look(_: bpy.types.Scene, graph: bpy.types.Depsgraph) -> None:
    """Look whether faces came to an object, or went."""
    for obj in changed_objects(graph):
        if _is_viewed(obj) and _n_faces.get(obj.session_uid) != len(obj.data.polygons):
            _n_faces[obj.session_uid] = len(obj.data.polygons)
            _start()


def _look_again(*_: object) -> None:
    """Look at all objects. Blender passes arguments to handlers."""
    _n_faces.clear()
    _start()


def stop() -> None:
    """Watch for joins no more."""
    stop_timer(bring_views_in_step)
    _n_faces.clear()


HANDLERS = {"depsgraph_update_post": _look, **dict.fromkeys(REPLACED, _look_again)}
