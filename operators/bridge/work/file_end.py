"""Lets go of what was computed when another file is loaded, and when Python ends.

Blender counts its memory then, and calls a ray tree that is left over an error.
"""

from __future__ import annotations

import atexit
from collections.abc import Callable

import bpy


def call_at_end(stop: Callable[..., None]) -> None:
    """Call a function whenever a file is loaded, and when Python ends.

    Parameters
    ----------
    stop : callable
        A persistent handler: it takes what Blender passes to handlers, or nothing.
    """
    atexit.register(stop)
    bpy.app.handlers.load_pre.append(stop)


def call_now_instead(stop: Callable[..., None]) -> None:
    """Undo `call_at_end`, and call the function.

    Parameters
    ----------
    stop : callable
    """
    bpy.app.handlers.load_pre.remove(stop)
    atexit.unregister(stop)
    stop()
