"""What the extension may leave behind in a window: none of it must stay."""

import bpy
from weak_convex_decomposition.operators import recut
from weak_convex_decomposition.operators.bridge.work import session_cache
from weak_convex_decomposition.operators.running import modal as running
from weak_convex_decomposition.operators.viewport import picking, sight_overlay


def leftovers():
    """Return the names of what is still there of a computation."""
    found = {
        "computation": running.current is not None,
        "picking": picking.current is not None,
        "overlay": sight_overlay.current is not None,
        "timer": bpy.app.timers.is_registered(recut._invoke),
    }
    return [name for name, there in found.items() if there]


def handlers():
    """Return the names of our functions among Blender's handlers, each time it is."""
    return [
        function.__name__
        for functions in map(bpy.app.handlers.__getattribute__, dir(bpy.app.handlers))
        if isinstance(functions, list)
        for function in functions
        if "weak_convex" in function.__module__
    ]


def remembered():
    """Return whether the lines of sight of a shape are kept."""
    return session_cache._cache is not None
