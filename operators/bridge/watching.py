"""Watch for changes through handlers and timers, and tell which objects changed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import Any

import bpy

# Blender calls the functions in these lists when all data may be others.
REPLACED = ("undo_post", "redo_post", "load_post")


def watch(handlers: Mapping[str, Callable[..., Any]]) -> None:
    """Let Blender call functions, each by the name of its list in `bpy.app.handlers`.

    They are made persistent, or Blender would drop them with the next file.
    """
    for name, handler in handlers.items():
        getattr(bpy.app.handlers, name).append(bpy.app.handlers.persistent(handler))


def unwatch(handlers: Mapping[str, Callable[..., Any]]) -> None:
    """Undo `watch`, also if another script has emptied Blender's lists."""
    for name, handler in handlers.items():
        with suppress(ValueError):
            getattr(bpy.app.handlers, name).remove(handler)


def start_timer(function: Callable[[], float | None], seconds: float = 0.0) -> None:
    """Let Blender call a function after a while, unless it waits for its time."""
    if not bpy.app.timers.is_registered(function):
        bpy.app.timers.register(function, first_interval=seconds)


def stop_timer(function: Callable[[], float | None]) -> None:
    """Call a function no more that waits for its time."""
    if bpy.app.timers.is_registered(function):
        bpy.app.timers.unregister(function)


def changed_objects(graph: bpy.types.Depsgraph) -> Iterator[bpy.types.Object]:
    """Yield the objects of the file whose geometry has changed with an update."""
    for update in graph.updates:
        if update.is_updated_geometry and isinstance(update.id, bpy.types.Object):
            yield update.id.original
