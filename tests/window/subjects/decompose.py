"""The button Decompose, its result, and undo."""

import bpy
from edited import record_of
from leftovers import leftovers
from snapshot import snapshot
from weak_convex_decomposition.operators.running import modal as running


def steps(hands):
    yield from hands.open_sidebar()
    before = snapshot(hands.suzanne(1))
    yield from hands.take_samples(300)
    hands.picture("before")
    place = yield from hands.find("wcd.decompose")
    yield from hands.click(place)
    yield lambda: running.current is not None
    hands.picture("running")
    yield lambda: running.current is None
    obj = bpy.context.active_object
    parts = record_of(obj)["parts"]
    assert "wcd_part" in obj.data.attributes
    assert len(obj.vertex_groups) == len(obj.data.materials) == len(parts) > 1
    assert leftovers() == []
    yield 0.5
    hands.picture("after")
    yield from hands.undo()
    yield lambda: "wcd" not in bpy.context.active_object
    assert snapshot(bpy.context.active_object) == before
