"""Another file, ten registrations: no run and no overlay stays where it was."""

import bpy
import weak_convex_decomposition as package
from leftovers import handlers, leftovers, remembered
from weak_convex_decomposition.operators.running import modal as running
from weak_convex_decomposition.operators.viewport import sight_overlay


def steps(hands):
    yield from hands.open_sidebar()
    hands.suzanne(1)
    bpy.context.scene.wcd.samples = 5000
    with hands.context():
        bpy.ops.wcd.decompose(samples=100)
        assert remembered() == 1
        bpy.ops.wcd.show_sight(face=0, samples=100)
        bpy.ops.wcd.decompose("INVOKE_DEFAULT", samples=5000)
    yield 0.5
    assert running.current is not None
    assert sight_overlay.current is not None
    there = handlers()
    with hands.context():
        bpy.ops.wm.read_homefile()
    yield 0.5
    assert leftovers() == []
    assert remembered() == 0
    assert handlers() == there

    yield from hands.open_sidebar()
    for _ in range(10):
        package.unregister()
        assert handlers() == []
        assert not hasattr(bpy.types.Scene, "wcd")
        yield 0.1
        package.register()
        assert handlers() == there
        yield 0.1
    yield from hands.open_sidebar()
    yield from hands.find("wcd.decompose")

    hands.suzanne(1)
    with hands.context():
        bpy.ops.wcd.show_sight(face=0, samples=100)
        bpy.ops.wcd.decompose("INVOKE_DEFAULT", samples=5000)
    yield 0.5
    assert running.current is not None
    assert sight_overlay.current is not None
    package.unregister()
    assert leftovers() == handlers() == []
    assert remembered() == 0
    yield 0.3
    package.register()
