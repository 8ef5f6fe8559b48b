"""Hulls and what falls in their shape: the button, the menu, and undo of both."""

import bpy
from leftovers import leftovers
from snapshot import snapshot
from weak_convex_decomposition.operators.running import modal as running

_FRAMES = range(1, 40)


def shape():
    body = bpy.context.active_object.rigid_body
    return body and body.collision_shape


def steps(hands):
    hands.open_panels("WCD_PT_hulls")
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    before = snapshot(hands.suzanne(0))
    place = yield from hands.find("wcd.build_hulls", columns=(0.5,))
    yield from hands.click(place)
    yield lambda: bpy.context.active_object.children
    yield lambda: running.current is None
    yield 0.5
    hulls = [obj.name for obj in bpy.context.active_object.children]
    built = snapshot(bpy.context.active_object)
    hands.picture("built")

    with hands.context():
        bpy.ops.wcd.make_rigid("INVOKE_DEFAULT", True, kind="ACTIVE")
    yield lambda: shape() == "COMPOUND"
    for frame in _FRAMES:
        bpy.context.scene.frame_set(frame)
    fallen = bpy.context.active_object.matrix_world.translation.z
    assert fallen < -1, fallen
    bpy.context.scene.frame_set(_FRAMES[0])

    yield from hands.undo()
    yield lambda: shape() is None
    assert bpy.context.scene.rigidbody_world is None
    assert snapshot(bpy.context.active_object) == built
    assert sorted(o.name for o in bpy.context.active_object.children) == sorted(hulls)
    yield from hands.undo()
    yield lambda: not bpy.context.active_object.children
    assert snapshot(bpy.context.active_object) == before
    assert leftovers() == []
