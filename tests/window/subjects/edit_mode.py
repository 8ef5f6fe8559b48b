"""Edit Mode is entered while parts are computed; each step is undone by itself."""

import bpy
from leftovers import leftovers
from snapshot import snapshot
from weak_convex_decomposition.operators.running import modal as running


def mode():
    return bpy.context.active_object.mode


def steps(hands):
    yield from hands.open_sidebar()
    before = snapshot(hands.suzanne(1))
    yield from hands.take_samples(800)
    place = yield from hands.find("wcd.decompose")
    yield from hands.click(place)
    yield lambda: running.current is not None
    area = hands.area
    yield from hands.move(area.x + area.width // 4, area.y + area.height // 2)
    yield from hands.press("Tab")
    yield lambda: mode() == "EDIT"
    assert running.current is not None
    yield lambda: running.current is None
    yield lambda: "wcd" in bpy.context.active_object
    assert leftovers() == []
    yield 0.5
    hands.picture("done")
    yield from hands.undo()
    yield lambda: "wcd" not in bpy.context.active_object
    assert mode() == "EDIT"
    yield from hands.undo()
    yield lambda: mode() == "OBJECT"
    assert snapshot(bpy.context.active_object) == before
