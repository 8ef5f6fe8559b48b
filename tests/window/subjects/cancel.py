"""Esc, the button Cancel and a run that fails leave everything as it was."""

import time

import bpy
from leftovers import leftovers
from snapshot import snapshot
from weak_convex_decomposition.operators.running import modal as running

# Seconds, on machines that do other things, too; `make bench-speed` measures steps.
_AT_ONCE = 2.0


def start(hands):
    place = yield from hands.find("wcd.decompose")
    yield from hands.click(place)
    yield lambda: running.current is not None
    yield 0.5
    assert running.current is not None


def steps(hands):
    yield from hands.open_sidebar()
    before = snapshot(hands.suzanne(1))
    bpy.context.scene.wcd.samples = 5000
    yield 0.5

    yield from start(hands)
    yield from hands.move(400, 500)
    began = time.monotonic()
    yield from hands.press("Escape")
    yield lambda: running.current is None
    seconds = time.monotonic() - began
    print(f"Esc took {seconds:.2f} s")
    assert seconds < _AT_ONCE
    assert snapshot(bpy.context.active_object) == before
    assert leftovers() == []

    yield from start(hands)
    place = yield from hands.find("wcd.cancel")
    hands.picture("button")
    yield from hands.click(place)
    yield lambda: running.current is None
    assert snapshot(bpy.context.active_object) == before
    assert leftovers() == []

    yield from start(hands)
    area = hands.area
    yield from hands.move(area.x + area.width // 3, area.y + area.height // 2)
    bpy.data.objects.remove(bpy.context.active_object)
    bpy.context.scene.wcd.samples = 100
    yield lambda: running.current is None
    assert leftovers() == []
    yield 0.5
    assert area.spaces.active.show_region_ui
    hands.picture("deleted")
    yield from hands.press("n")  # the error opens no popup, which would take the key
    yield 0.5
    assert not area.spaces.active.show_region_ui
