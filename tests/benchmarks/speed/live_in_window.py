"""Live, Pick Parts and the overlay in a real window: Suzanne, 7,872 and 126,000 faces.

    blender --python tests/window/drive.py -- tests/benchmarks/speed/live_in_window.py

Where the processor draws, a small window shows best what the extension takes:
SCREEN="900 700" .tools/blender_window run ROOT --python ...

For each number of parts: the seconds from the setting until the parts are written, and
until they, or their exact seams, are drawn; how much of that Blender drew viewports,
and how often; and the longest step, which is the longest time of the processor in the
extension's own code. First the hand rests half a second between two
numbers, and then, with nothing kept, long enough for parts to be found ahead. Then
Detail changes. Then the same for the start of Pick Parts, what hovers first and later,
and what drawing the overlay adds to drawing the window.
"""

import sys
import time
from pathlib import Path

import bpy
from weak_convex_decomposition.operators import recut
from weak_convex_decomposition.operators.bridge.stored.record import (
    is_rough,
    noted_parameters,
)
from weak_convex_decomposition.operators.bridge.work import session_cache
from weak_convex_decomposition.operators.bridge.work.run_edit import Edited
from weak_convex_decomposition.operators.running import ahead, refine
from weak_convex_decomposition.operators.running import modal as running
from weak_convex_decomposition.operators.settings import parameters_from
from weak_convex_decomposition.operators.viewport import pick_parts

sys.path.append(str(Path(__file__).parent))
from in_window import Pulse

UP, DOWN, FAR = range(3, 13), range(11, 2, -1), (5, 11, 16, 20, 24)
DETAILS, FINER = (1.75, 1.5, 1.0, 0.5), (2.25, 2.5, 3.0, 5.0)
SMALLEST = (0.002, 0.01, 0.02, 0.03)


class View:
    """When parts were written and drawn, and how long drawings took."""

    def __init__(self):
        self.restart()
        add, write = bpy.types.SpaceView3D.draw_handler_add, Edited.write
        add(self._begin, (), "WINDOW", "PRE_VIEW")
        add(self._end, (), "WINDOW", "POST_PIXEL")

        def written(edited, obj):
            write(edited, obj)
            self.written, self.drawn = time.perf_counter(), None

        Edited.write = written

    def restart(self):
        self.written = self.drawn = None
        self.drawing, self.n_drawings = 0.0, 0

    def _begin(self):
        self._began = time.perf_counter()

    def _end(self):
        now = time.perf_counter()
        self.drawing += now - self._began
        self.n_drawings += 1
        if self.drawn is None and self.written is not None:
            self.drawn = now


def decompose(hands):
    """Find the first parts; nothing is kept from before."""
    session_cache.forget()
    with hands.context():
        bpy.ops.wcd.decompose()
        bpy.ops.ed.undo_push(message="Parts")


def live(pulse, view, name, values, rest, exact=False):
    """Change a setting again and again, and wait for the parts, or for exact ones."""
    print(f"{name}, {rest} s between two values{', until exact' if exact else ''}:")
    settings, obj = bpy.context.scene.wcd, bpy.context.active_object
    settings.live = True
    for value in values:
        yield rest
        pulse.restart()
        view.restart()
        before, cpu = time.perf_counter(), time.thread_time()
        setattr(settings, name, value)
        yield (
            lambda: (
                noted_parameters(obj) == parameters_from(settings)
                and view.drawn is not None
                and running.current is None
                and not (exact and is_rough(obj))
            )
        )
        cpu = time.thread_time() - cpu
        print(
            f"{value:4} {len(obj.wcd_parts):2} parts, written"
            f" {view.written - before:5.2f} s, drawn {view.drawn - before:5.2f},"
            f" drawing {view.drawing:5.2f} in {view.n_drawings},"
            f" {cpu:5.2f} of CPU, step {pulse.step:.3f}"
        )


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


def anew(hands):
    """Decompose with default settings."""
    scene = bpy.context.scene.wcd
    scene.live = False
    scene.parts, scene.alpha, scene.smallest_part = 0, 2.0, 0.005
    decompose(hands)


def settings(hands, pulse, view):
    """Change all that Live follows."""
    anew(hands)
    yield from live(pulse, view, "parts", (*UP, *DOWN), 0.5)
    yield from live(pulse, view, "alpha", DETAILS, 0.5)
    anew(hands)
    yield from live(pulse, view, "alpha", FINER, 0.5)
    anew(hands)
    yield from live(pulse, view, "smallest_part", SMALLEST, 0.5)
    for values, rest, exact in (
        (FAR, 0.5, False),
        (UP, 5.0, False),
        (FAR, 5.0, True),
        (UP, 0.5, True),
    ):
        anew(hands)
        yield from live(pulse, view, "parts", values, rest, exact)


def steps(hands):
    bpy.context.preferences.system.viewport_aa = "OFF"
    pulse, view = Pulse(), View()
    pulse.watch(recut.WCD_OT_recut, "execute")
    ahead.go_on = pulse.timed(ahead.go_on)
    refine.go_on = pulse.timed(refine.go_on)
    yield from hands.open_sidebar()
    for subdivisions in (2, 4):
        hands.suzanne(subdivisions)
        print(f"{len(bpy.context.active_object.data.polygons):,} faces")
        yield from settings(hands, pulse, view)
    bpy.context.scene.wcd.live = False
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
