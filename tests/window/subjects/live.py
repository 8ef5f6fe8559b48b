"""With Live on, a slider cuts anew as it is dragged; undo takes it back.

Parts of a large mesh are seen roughly at first, and exactly once the hand rests.
"""

import time

import bpy
from edited import record_of
from leftovers import leftovers
from weak_convex_decomposition.operators.bridge.mesh.attributes import read_ints
from weak_convex_decomposition.operators.bridge.stored.record import is_rough
from weak_convex_decomposition.operators.running import modal as running

# Where the number of parts is dragged to, in points.
_OFFSETS = (5, 10, 15, 20)


def n_parts():
    return record_of(bpy.context.active_object)["k"]


def labels():
    return read_ints(
        bpy.context.active_object.data.attributes["wcd_part"].data, "value"
    )


def steps(hands):
    yield from hands.open_sidebar()
    hands.suzanne(2)
    settings = bpy.context.scene.wcd
    settings.parts = 4
    settings.samples = 600
    with hands.context():
        bpy.ops.wcd.decompose(parts=4, samples=600)
        bpy.ops.ed.undo_push(message="Parts")
    assert n_parts() == 4
    place = yield from hands.find("wcd.live")
    yield from hands.click(place)
    yield lambda: bpy.context.scene.wcd.live

    place = yield from hands.find("wcd.parts")
    yield from hands.drag(place, _OFFSETS)
    yield lambda: not running.current
    chosen = bpy.context.scene.wcd.parts
    assert chosen != 4
    yield lambda: n_parts() == chosen
    assert leftovers() == []
    yield 0.5
    hands.picture("dragged")
    # A cut that takes longer than a moment is a step of its own, one on the way, too.
    for _ in range(len(_OFFSETS) + 1):
        if bpy.context.scene.wcd.parts != 4:
            yield from hands.undo()
            yield 1.0
    assert bpy.context.scene.wcd.parts == 4
    assert n_parts() == 4

    # Every number in its turn, and how long each takes.
    bpy.context.scene.wcd.live = True
    for k in range(2, 21):
        began = time.perf_counter()
        bpy.context.scene.wcd.parts = k
        print(f"{k} parts: {time.perf_counter() - began:.2f} s")
        yield lambda: not leftovers()
        yield lambda k=k: n_parts() == k
    hands.picture("twenty")

    # A changed mesh is noticed, and seen anew while the window stays alive.
    bpy.context.active_object.data.vertices[0].co.x += 0.05
    bpy.context.scene.wcd.parts = 6
    yield lambda: running.current is not None
    yield lambda: running.current is None
    assert n_parts() == 6
    assert leftovers() == []
    yield from locked(hands)
    yield from large(hands)


def locked(hands):
    """Ask for fewer parts than are locked: the parts stay, and the window says why."""
    settings = bpy.context.scene.wcd
    for row in bpy.context.active_object.wcd_parts[:3]:
        row.locked = True
    settings.parts = 2
    yield 1.0
    yield lambda: running.current is None
    assert n_parts() == 6
    hands.picture("locked")
    settings.live = False
    settings.parts = 6
    for row in bpy.context.active_object.wcd_parts:
        row.locked = False


def large(hands):
    """Change settings of a mesh of 126,000 faces, and undo while seams are rough."""
    settings = bpy.context.scene.wcd  # undo has replaced the former ones
    settings.live = False
    bpy.context.preferences.system.viewport_aa = "OFF"  # drawn once is enough
    hands.suzanne(4)
    with hands.context():
        bpy.ops.wcd.decompose(parts=4, samples=600)
        bpy.ops.ed.undo_push(message="Parts")
    settings.parts, settings.live = 4, True
    for k in (5, 7):  # as a slider does, which is an undo step
        with hands.context():
            bpy.ops.wm.context_set_int(
                "EXEC_DEFAULT", True, data_path="scene.wcd.parts", value=k
            )
        yield lambda k=k: n_parts() == k and running.current is None
        assert is_rough(bpy.context.active_object)
        with hands.context():
            assert not bpy.ops.wcd.explode.poll()
    yield lambda: not is_rough(bpy.context.active_object)
    hands.picture("seams")
    seven = labels()
    yield from hands.undo()
    yield lambda: n_parts() == 5 and not is_rough(bpy.context.active_object)
    with hands.context():
        assert bpy.ops.wcd.explode.poll()
        bpy.ops.ed.redo()
    yield lambda: n_parts() == 7 and not is_rough(bpy.context.active_object)
    assert (labels() == seven).all()
    with hands.context():
        bpy.ops.wcd.decompose(parts=7, samples=600)
    assert (labels() == seven).all()
