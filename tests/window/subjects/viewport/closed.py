"""A window is closed while something of ours runs or waits in it.

Blender takes the window from its list before it ends our operator. It must survive
that, and nothing may be left behind in the other window.
"""

import bpy
from leftovers import leftovers
from snapshot import snapshot
from weak_convex_decomposition.operators.running import modal as running
from weak_convex_decomposition.operators.viewport import picking, sight_overlay


def second_window(hands):
    """Open another window with a 3D view; return how to call an operator in it."""
    with hands.context():
        bpy.ops.wm.window_new()
    yield 0.7
    window = hands.manager.windows[-1]
    assert window != hands.window
    area = max(window.screen.areas, key=lambda each: each.width * each.height)
    area.type = "VIEW_3D"
    yield 0.4
    region = next(each for each in area.regions if each.type == "WINDOW")
    return {"window": window, "area": area, "region": region}


def close(hands, place):
    with bpy.context.temp_override(**place):
        bpy.ops.wm.window_close()
    yield 0.7
    assert len(hands.manager.windows) == 1


def steps(hands):
    yield from hands.open_sidebar()
    before = snapshot(hands.suzanne(1))
    place = yield from second_window(hands)
    with bpy.context.temp_override(**place):
        bpy.ops.wcd.decompose("INVOKE_DEFAULT", samples=5000)
    yield 0.5
    assert running.current is not None
    yield from close(hands, place)
    assert running.current is None
    assert snapshot(bpy.context.active_object) == before
    assert leftovers() == []

    yield from hands.parted_suzanne(1, samples=300)
    place = yield from second_window(hands)
    with bpy.context.temp_override(**place):
        bpy.ops.wcd.pick_parts("INVOKE_DEFAULT")
    yield 0.3
    assert picking.current is not None
    yield from close(hands, place)
    assert picking.current is None

    place = yield from second_window(hands)
    with bpy.context.temp_override(**place):
        bpy.ops.wcd.show_sight("INVOKE_DEFAULT")
    yield lambda: running.current is None
    assert sight_overlay.current is not None
    yield from close(hands, place)
    assert sight_overlay.current is None
    assert leftovers() == []
    hands.picture("status")
