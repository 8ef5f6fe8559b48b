"""Live, Pick Parts and the overlay in a real window, on Suzanne with 126,000 faces.

    blender --python tests/window/drive.py -- tests/benchmarks/speed/live_in_window.py

For each number of parts: the seconds from the setting until the parts are written, and
the longest step, which is the longest time of the processor in the extension's own
code. First the hand rests half a second between two numbers, and then, with nothing
kept, long enough for parts to be found ahead. Then the same for the start of Pick
Parts, what hovers first and later, and what drawing the overlay adds to drawing the
window.
"""

import sys
import time
from pathlib import Path

import bpy
from weak_convex_decomposition.operators import recut
from weak_convex_decomposition.operators.bridge.work import session_cache
from weak_convex_decomposition.operators.running import ahead
from weak_convex_decomposition.operators.running import modal as running
from weak_convex_decomposition.operators.viewport import pick_parts

sys.path.append(str(Path(__file__).parent))
from in_window import Pulse

UP, DOWN = range(3, 13), range(11, 2, -1)


def decompose(hands):
    """Find the first parts; nothing is kept from before."""
    session_cache.forget()
    with hands.context():
        bpy.ops.wcd.decompose()
        bpy.ops.ed.undo_push(message="Parts")


def live(pulse, numbers, rest):
    """Set the number of parts again and again, and wait for the parts."""
    print(f"{rest} s between two numbers:")
    bpy.context.scene.wcd.live = True
    obj = bpy.context.active_object
    for k in numbers:
        yield rest
        pulse.restart()
        before, cpu = time.perf_counter(), time.thread_time()
        bpy.context.scene.wcd.parts = k
        yield lambda k=k: len(obj.wcd_parts) == k and running.current is None
        seconds, cpu = time.perf_counter() - before, time.thread_time() - cpu
        print(f"{k:3} parts {seconds:6.2f} s, {cpu:5.2f} of CPU, step {pulse.step:.3f}")


def hovering(hands, pulse):
    """Pick parts: the start, and one place after the other."""
    pulse.watch(pick_parts.WCD_OT_pick_parts, "invoke", "modal")
    pulse.restart()
    with hands.context():
        bpy.ops.wcd.pick_parts("INVOKE_DEFAULT")
    print(f"Pick Parts: {pulse.step:.3f}")
    yield 0.3  # a hand takes as long from the button to the model
    region = hands.region("WINDOW")
    for share in (0.5, 0.52, 0.55, 0.6):
        pulse.restart()
        x, y = region.x + share * region.width, region.y + 0.5 * region.height
        yield from hands.move(int(x), int(y))
        yield 0.5
        print(f"hover: {pulse.step:.3f}")
    yield from hands.press("Escape")
    yield 0.5


def drawing(hands):
    """Return how long a drawing of the window takes, in seconds of the processor."""
    with hands.context():
        bpy.ops.wm.redraw_timer(type="DRAW_WIN", iterations=1)
        before = time.process_time()
        bpy.ops.wm.redraw_timer(type="DRAW_WIN", iterations=5)
    return (time.process_time() - before) / 5


def steps(hands):
    bpy.context.preferences.system.viewport_aa = "OFF"
    pulse = Pulse()
    pulse.watch(recut.WCD_OT_recut, "execute")
    ahead.go_on = pulse.timed(ahead.go_on)
    yield from hands.open_sidebar()
    hands.suzanne(4)
    decompose(hands)
    yield from live(pulse, (*UP, *DOWN), 0.5)
    bpy.context.scene.wcd.live = False
    decompose(hands)
    yield from live(pulse, UP, 5.0)
    yield from hovering(hands, pulse)
    before = drawing(hands)
    with hands.context():
        bpy.ops.wcd.show_colors(colors="OVERLAY")
    began = time.process_time()
    with hands.context():
        bpy.ops.wm.redraw_timer(type="DRAW_WIN", iterations=1)
    first = time.process_time() - began
    after = drawing(hands)
    print(f"drawn: {before:.3f}, with overlay {after:.3f}, its first time {first:.3f}")
