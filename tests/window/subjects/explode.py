"""The exploded view: its button, its slider, and undo; the mesh stays as it is."""

import bpy
import numpy as np
from leftovers import leftovers
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.views.exploding import (
    exploding,
    slider,
)


def extent():
    """Return the diagonal of the object as it is shown."""
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.context.active_object.evaluated_get(graph).data
    places = np.zeros(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", places)
    return float(np.linalg.norm(np.ptp(places.reshape(-1, 3), axis=0)))


def distance():
    owner, path = slider(exploding(bpy.context.active_object))
    return owner.value if path == "value" else owner[path[2:-2]]


def steps(hands):
    hands.open_panels("WCD_PT_parts", "WCD_PT_use")
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    yield from hands.parted_suzanne(2, samples=600)
    before, whole = snapshot(bpy.context.active_object), extent()

    place = yield from hands.find("wcd.explode", columns=(0.5,))
    yield from hands.click(place)
    yield lambda: exploding(bpy.context.active_object)
    yield 0.5
    assert extent() > 1.1 * whole
    after = snapshot(bpy.context.active_object)
    assert after["mesh"] == before["mesh"]
    yield from hands.undo()
    yield lambda: not exploding(bpy.context.active_object)
    assert snapshot(bpy.context.active_object) == before
    yield from hands.press("ctrl+shift+z")
    yield lambda: exploding(bpy.context.active_object)
    assert snapshot(bpy.context.active_object) == after
    hands.look()
    yield 0.5
    hands.picture("exploded", hands.cutout())

    first, far = distance(), extent()
    place = yield from hands.find("Socket_", columns=(0.5,))
    yield from hands.drag(place, (5, 10, 20, 30))
    hands.picture("dragged", hands.area)
    yield lambda: distance() > first
    yield 0.5
    assert extent() > far
    yield from hands.undo()
    yield lambda: distance() == first

    place = yield from hands.find("wcd.implode", columns=(0.9,))
    yield from hands.click(place)
    yield lambda: not exploding(bpy.context.active_object)
    yield 0.5
    assert snapshot(bpy.context.active_object) == before
    assert extent() == whole
    assert leftovers() == []
    yield from hands.undo()
    yield lambda: exploding(bpy.context.active_object)
    assert snapshot(bpy.context.active_object) == after
