"""Seconds and freezes of runs in a real window, beside those of a script.

    make bench-window BLENDER=blender

A subject for tests/window/drive.py: the tab is opened, the libraries load, and the
button's operator runs on Suzanne and on finer ones. Seconds count until Blender has
drawn the result. The longest freeze is the longest time between two of its rounds; the
longest step is the longest time of the processor in the extension's own code. "own" is
all time in it; the rest is Blender's, which draws the window. A script's seconds are
those of the same operator without slices, right after, in the same process; "drawn"
are those until its result is drawn, too. The first ratio is of all seconds to these,
the second of our own to the script's. Rows with ratios are medians of three runs.

Words after the subject: `at-once` starts the first run before any library is loaded;
`ten-million` runs on a ring of ten million triangles, which is drawn as its bounds;
`hulls` builds hulls in place of parts, once for each model.
"""

import resource
import sys
import time

import bpy
import numpy as np
from large_shapes import lumpy_ring
from weak_convex_decomposition.operators.bridge.work import libraries, session_cache
from weak_convex_decomposition.operators.running import modal as running
from weak_convex_decomposition.operators.running.computation import Computation

# Name, subdivisions of Suzanne, and whether her quads are cut into triangles.
MODELS = (
    ("Suzanne", 2, False),
    ("126k faces", 4, False),
    ("504k faces", 5, False),
    ("1.0M faces", 5, True),
)
ROUNDS = 3
_BEAT = 0.005


class Pulse:
    """The longest time between two rounds of Blender, and in the extension's code."""

    def __init__(self):
        bpy.app.timers.register(self._beat, persistent=True)
        add = bpy.types.SpaceView3D.draw_handler_add
        add(self._draw, (), "WINDOW", "POST_PIXEL")
        self.watch(Computation, "invoke", "modal")
        libraries._load_next = self.timed(libraries._load_next)
        self.restart()

    def timed(self, function):
        """Return a function that does the same, and has its time taken."""
        return lambda: self._time(function)

    def watch(self, kind, *names):
        """Take the time of methods of an operator."""
        for name in names:
            setattr(kind, name, self._timed(getattr(kind, name), name))

    def _timed(self, method, name):
        # Blender counts the parameters of an operator's methods.
        if name == "execute":
            return lambda op, context: self._time(method, op, context)
        return lambda op, context, event: self._time(method, op, context, event)

    def restart(self):
        self.freeze = self.step = self.own = 0.0
        self._began = self._last = time.perf_counter()
        self.seconds = None  # until a run has ended, and its result is drawn
        self._drawn = False

    def figures(self, seconds):
        """Return the first columns of a row."""
        return [seconds, self.own, self.freeze, self.step]

    def _beat(self):
        now = time.perf_counter()
        self.freeze, self._last = max(self.freeze, now - self._last), now
        if self.seconds is None and self._drawn:
            self.seconds = now - self._began
        return _BEAT

    def _draw(self):
        self._drawn = running.current is None

    def _time(self, function, *arguments):
        before, began = time.thread_time(), time.perf_counter()
        try:
            return function(*arguments)
        finally:
            self.step = max(self.step, time.thread_time() - before)
            self.own += time.perf_counter() - began


def row(name, figures):
    """Print a row of the table."""
    print(f"{name:22}{''.join(f'{figure:9.2f}' for figure in figures)}", flush=True)


def bare(hands):
    """Take the parts off the object, and forget what is known of it."""
    session_cache.forget()
    with hands.context():
        if bpy.ops.wcd.clear.poll():
            bpy.ops.wcd.clear()
    yield 1.0


def in_slices(hands, pulse, operator=bpy.ops.wcd.decompose):
    """Press a button, as it were; return the first columns of a row."""
    yield from bare(hands)
    pulse.restart()
    with hands.context():
        operator("INVOKE_DEFAULT", True)
    yield lambda: pulse.seconds
    return pulse.figures(pulse.seconds)


def at_once(hands, pulse):
    """Run as a script does; return the seconds, and those until the result is drawn."""
    yield from bare(hands)
    pulse.restart()
    with hands.context():
        before = time.perf_counter()
        bpy.ops.wcd.decompose()
        written = time.perf_counter() - before
    yield lambda: pulse.seconds
    return [written, pulse.seconds]


def beside_script(hands, pulse, name):
    """Print a row of medians."""
    rows = []
    for _ in range(ROUNDS):
        figures = yield from in_slices(hands, pulse)
        written, drawn = yield from at_once(hands, pulse)
        ratios = figures[0] / drawn, figures[1] / written
        rows.append([*figures, written, drawn, *ratios])
    row(name, np.median(rows, axis=0))


def model(hands, subdivisions, cut):
    """Put a Suzanne there, of quads or triangles."""
    obj = hands.suzanne(subdivisions)
    if cut:
        with hands.context():
            obj.modifiers.new("Triangulate", "TRIANGULATE")
            bpy.ops.object.modifier_apply(modifier="Triangulate")
            bpy.ops.ed.undo_push(message="Triangles")
    return obj


def ring(hands):
    """Put a ring of ten million triangles there, drawn as its bounds."""
    found = lumpy_ring(10_000_000)
    corners = found.triangles.reshape(-1, 6)[:, [0, 1, 2, 5]]  # of quads
    mesh = bpy.data.meshes.new("Ring")
    mesh.vertices.add(len(found.vertices))
    mesh.vertices.foreach_set("co", found.vertices.astype(np.float32).ravel())
    mesh.loops.add(corners.size)
    mesh.loops.foreach_set("vertex_index", corners.astype(np.int32).ravel())
    mesh.polygons.add(len(corners))
    starts = np.arange(0, corners.size, 4, dtype=np.int32)
    mesh.polygons.foreach_set("loop_start", starts)
    mesh.update(calc_edges=True)
    for other in list(bpy.data.objects):
        bpy.data.objects.remove(other)
    obj = bpy.data.objects.new("Ring", mesh)
    obj.display_type = "BOUNDS"
    with hands.context():
        bpy.context.collection.objects.link(obj)
        bpy.context.view_layer.objects.active = obj
        obj.select_set(True)
        bpy.ops.ed.undo_push(message="Ring")


def steps(hands):
    pulse = Pulse()
    # Blender would draw the view again and again after each change, to smooth edges.
    bpy.context.preferences.system.viewport_aa = "OFF"
    print(f"Blender {bpy.app.version_string}")
    titles = (
        *("seconds", "own", "freeze", "step"),
        *("script", "drawn", "ratio", "own"),
    )
    print(f"{'':22}{''.join(f'{title:>9}' for title in titles)}")
    model(hands, 2, False)
    yield 2.0
    pulse.restart()
    before = time.perf_counter()
    yield from hands.open_sidebar()
    if "at-once" not in sys.argv:
        yield lambda: not any(libraries._missing())
        yield 0.5
        row("libraries, idle", pulse.figures(time.perf_counter() - before))
        row("first run", (yield from in_slices(hands, pulse)))
    else:
        row("first run, at once", (yield from in_slices(hands, pulse)))
        return
    if "ten-million" in sys.argv:
        ring(hands)
        yield 2.0
        row("10M triangles", (yield from in_slices(hands, pulse)))
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
        print(f"peak memory of the process, Blender and all: {peak:.1f} GB")
        return
    for name, subdivisions, cut in MODELS:
        model(hands, subdivisions, cut)
        yield 2.0
        if "hulls" in sys.argv:
            row(name, (yield from in_slices(hands, pulse, bpy.ops.wcd.build_hulls)))
        else:
            yield from beside_script(hands, pulse, name)
