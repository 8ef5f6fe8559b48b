"""What an artist does to look at parts: measures, selects, isolates, chooses, draws."""

import bpy
from hand_made import in_mode
from hypothesis import strategies as st
from hypothesis.stateful import rule
from weak_convex_decomposition.core.parameters.choices import PICTURES
from weak_convex_decomposition.core.parameters.presets import PRESETS

from .checks import attempt
from .more_hands import FAST, NAMES, NUMBERS

KINDS = st.sampled_from([each.identifier for each in PICTURES])
NAMED_SETTINGS = st.sampled_from([each.identifier for each in PRESETS])


class Looks:
    """Rules beside those of `RestlessArtist`, whose methods they use."""

    @rule(n=NUMBERS, selected=st.booleans())
    def measure(self, n, selected):
        obj = self.body(n)
        if selected:
            self.select(obj, 0, 20)
            in_mode(obj, "EDIT")
        call = bpy.ops.wcd.measure_selection if selected else bpy.ops.wcd.measure
        attempt(call, samples=FAST["samples"])
        attempt(bpy.ops.wcd.tell_quality)
        self.done()

    @rule(n=NUMBERS, boundary=st.booleans(), extend=st.booleans())
    def select_by_parts(self, n, boundary, extend):
        self.body(n)
        call = bpy.ops.wcd.select_boundary if boundary else bpy.ops.wcd.select_parts
        attempt(call, extend=extend)
        self.done()

    @rule(n=NUMBERS, hide=st.booleans())
    def isolate(self, n, hide):
        self.body(n)
        attempt(bpy.ops.wcd.isolate_parts, hide=hide)
        bpy.context.view_layer.update()
        self.done()

    @rule(n=NUMBERS, number=NUMBERS, extend=st.booleans(), name=NAMES)
    def choose(self, n, number, extend, name):
        self.body(n)
        attempt(bpy.ops.wcd.choose_part, number=number, extend=extend)
        attempt(bpy.ops.wcd.rename_part, name=name)
        self.done()

    @rule(n=NUMBERS, row=NUMBERS)
    def lock(self, n, row):
        self.body(n).wcd_active_part = row
        attempt(bpy.ops.wcd.lock_parts)
        self.done()

    @rule(n=NUMBERS, kind=KINDS)
    def show_picture(self, n, kind):
        self.object_mode()
        self.body(n)
        attempt(bpy.ops.wcd.show_picture, picture=kind)
        self.done()

    @rule(preset=NAMED_SETTINGS)
    def use_preset(self, preset):
        attempt(bpy.ops.wcd.use_preset, preset=preset)
        for name, value in FAST.items():  # the next runs stay quick
            setattr(bpy.context.scene.wcd, name, value)
        self.done()
