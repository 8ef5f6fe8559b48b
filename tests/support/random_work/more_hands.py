"""What else an artist does: hulls, names of all parts, seams, colors, what is seen."""

import bpy
from hypothesis import strategies as st
from hypothesis.stateful import rule
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of

from .checks import attempt
from .locks import locks_hold

FAST = {"samples": 24, "containers": "HOLLOW", "max_parts": 4}
NUMBERS = st.integers(0, 5)
NAMES = st.sampled_from(["Head", "Ear.L", "Ear.R", "Part 01", "Part 03", "Leg.001", ""])
SHAPES = st.sampled_from(["HULL", "BOX", "SPHERE", "CAPSULE", "CYLINDER"])
MESHES = st.sampled_from(["ORIGINAL", "EVALUATED"])
LIVE_KINDS = st.sampled_from(["MIRROR", "ARRAY", "SUBSURF", "WIREFRAME", "BUILD"])
WAYS = st.sampled_from(
    [
        {"way": "NUMBER", "pattern": "Limb ##"},
        {"way": "NUMBER", "pattern": "Part ##"},
        {"way": "NUMBER", "pattern": "same"},
        {"way": "REPLACE", "find": "Part", "replace": "Bone"},
        {"way": "REPLACE", "find": "0", "replace": ""},
        {"way": "TYPE"},
    ]
)


class MoreHands:
    """Rules beside those of `RestlessArtist`, whose methods they use."""

    @rule(n=NUMBERS, shape=SHAPES, mesh=MESHES, by_part=st.booleans())
    def build_hulls(self, n, shape, mesh, by_part):
        self.object_mode()
        pieces = "PARTS" if by_part else "BY_ERROR"
        options = {"pieces": pieces, "max_error": 0.5, "shape": shape, "mesh": mesh}
        self.body(n)
        attempt(bpy.ops.wcd.build_hulls, **options)
        self.done()

    @rule(n=NUMBERS, hull=NUMBERS, shape=SHAPES, what=st.integers(0, 7))
    def change_hull(self, n, hull, shape, what):
        self.object_mode()
        obj = self.body(n)
        hulls = hulls_of(obj)
        if not hulls:
            return
        hull = hulls[hull % len(hulls)]
        if what < 2:
            attempt(bpy.ops.wcd.refit_hull, hull=hull.name, shape=shape)
        elif what == 2:
            attempt(bpy.ops.wcd.remove_hull, hull=hull.name)
        elif what == 3:
            attempt(bpy.ops.wcd.remove_hulls)
        elif what == 4:
            hull.name = "Mine"
        elif what == 5:
            attempt(bpy.ops.wcd.show_hulls, look="WIRE")
        elif what == 6:
            attempt(bpy.ops.wcd.make_rigid)
        else:
            bpy.data.objects.remove(hull)
        bpy.context.view_layer.update()
        self.done()

    @rule(n=NUMBERS, name=st.sampled_from(["Ape", "Bone", "Bone.001"]))
    def rename_object(self, n, name):
        obj = self.body(n)
        obj.name = obj.data.name = name
        self.done()

    @rule(n=NUMBERS, size=st.sampled_from([1.0, 0.5, -1.0]), apply=st.booleans())
    def stretch(self, n, size, apply):
        self.object_mode()
        self.body(n).scale.y = size
        if apply:
            attempt(bpy.ops.object.transform_apply, location=False)
        bpy.context.view_layer.update()
        self.done()

    @rule(n=NUMBERS, names=WAYS, chosen=st.booleans())
    def rename_all(self, n, names, chosen):
        self.body(n)
        scope = "CHOSEN" if chosen else "ALL"
        attempt(bpy.ops.wcd.rename_parts, scope=scope, **names)
        self.done()

    @rule(n=NUMBERS, unmark=st.booleans(), chosen=st.booleans())
    def seams(self, n, unmark, chosen):
        self.body(n)
        if unmark:
            attempt(bpy.ops.wcd.unmark_seams)
        else:
            attempt(bpy.ops.wcd.mark_seams, scope="CHOSEN" if chosen else "ALL")
        self.done()

    @rule(n=NUMBERS, colors=st.sampled_from(["MATERIALS", "OVERLAY"]))
    def show_colors(self, n, colors):
        self.object_mode()
        self.body(n)
        attempt(bpy.ops.wcd.show_colors, colors=colors)
        self.done()

    @rule(n=NUMBERS, kind=LIVE_KINDS, parts=st.sampled_from([0, 2, 3]))
    def decompose_what_is_seen(self, n, kind, parts):
        self.object_mode()
        obj = self.body(n)
        if len(obj.data.polygons) > 150:
            return
        modifier = obj.modifiers.new("Seen", kind)
        bpy.context.view_layer.update()
        with locks_hold(obj):
            attempt(bpy.ops.wcd.decompose, **FAST, parts=parts, mesh="EVALUATED")
        obj.modifiers.remove(modifier)
        bpy.context.view_layer.update()
        self.done()

    @rule(n=NUMBERS, parts=st.integers(1, 6), live=st.booleans())
    def cut_again(self, n, parts, live):
        settings = bpy.context.scene.wcd
        with locks_hold(self.body(n)):
            if live:
                settings.live = True
                settings.parts = parts
                settings.live = False
            else:
                attempt(bpy.ops.wcd.choose_part_count, parts=parts)
        self.done()
