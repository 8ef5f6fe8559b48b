"""A state machine that works on objects with parts as a restless artist would."""

import bpy
import numpy as np
from hand_made import in_mode
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from .checks import (
    attempt,
    bodies,
    bone,
    check_body,
    check_cleared,
    check_file_cleared,
    only,
)
from .locks import locks_hold
from .looks import Looks
from .more_hands import FAST, NAMES, NUMBERS, MoreHands

PARTS = st.sampled_from([0, 2, 3, 4, 6])
SEAMS = st.sampled_from(["KEEP", "KEEP", "CUT"])
COLORED = st.sampled_from(["MATERIALS", "OVERLAY"])
COLORS = st.tuples(*[st.sampled_from([0.1, 0.4, 0.8])] * 3)
KINDS = st.sampled_from(["ARRAY", "MIRROR", "SUBSURF", "TRIANGULATE"])
OPERATORS = (
    "merge_parts",
    "split_parts",
    "smooth_seams",
    "mirror_parts",
    "refresh_parts",
    "face_sets",
    "color_attribute",
    *("explode", "implode"),
    "clear",
    "separate",
)


class RestlessArtist(MoreHands, Looks, RuleBasedStateMachine):
    """Operators of ours and of Blender's, in any order."""

    folder = None  # where files are saved

    @initialize()
    def begin(self):
        """Start with one object in an empty file."""
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        bone()
        for name, value in FAST.items():  # of runs without parameters of their own
            setattr(bpy.context.scene.wcd, name, value)
        self.saved = None
        attempt(bpy.ops.wcd.decompose, **FAST, parts=3)
        bpy.ops.ed.undo_push(message="begin")

    def body(self, number):
        """Return an object, made the active one, in the mode that is on."""
        there = bodies()
        active = bpy.context.view_layer.objects.active
        if not there:
            return bone()
        if active in there and active.mode == "EDIT":
            return active
        obj = there[number % len(there)]
        only(obj)
        return obj

    def object_mode(self):
        """Leave Edit Mode."""
        active = bpy.context.view_layer.objects.active
        if active is not None and active.mode == "EDIT":
            bpy.ops.object.mode_set(mode="OBJECT")

    def done(self):
        """End a step, to be undone."""
        bpy.ops.ed.undo_push(message="step")

    @rule(n=NUMBERS, parts=PARTS, keep_edits=st.booleans(), seams=SEAMS, colors=COLORED)
    def decompose(self, n, **options):
        with locks_hold(self.body(n)):
            attempt(bpy.ops.wcd.decompose, **FAST, **options)
        self.done()

    @rule(n=NUMBERS, name=st.sampled_from(OPERATORS))
    def operate(self, n, name):
        self.body(n)
        attempt(getattr(bpy.ops.wcd, name))
        bpy.context.view_layer.update()
        self.done()

    @rule(n=NUMBERS, row=NUMBERS, name=NAMES, color=COLORS, what=NUMBERS)
    def change_row(self, n, row, name, color, what):
        rows = self.body(n).wcd_parts
        if not rows:
            return
        row = rows[row % len(rows)]
        if what < 2:
            row.name = name
        elif what == 2:
            row.locked = not row.locked
        elif what == 3:
            row.color = color
        else:
            row.chosen = not row.chosen
        self.done()

    @rule(n=NUMBERS, row=NUMBERS, from_face=st.integers(0, 50))
    def assign(self, n, row, from_face):
        obj = self.body(n)
        self.select(obj, from_face, 8)
        in_mode(obj, "EDIT")
        obj.wcd_active_part = row
        attempt(bpy.ops.wcd.assign_faces)
        self.done()

    @rule(n=NUMBERS, from_face=st.integers(0, 50), how_many=st.integers(1, 20))
    def delete_faces(self, n, from_face, how_many):
        obj = self.body(n)
        self.select(obj, from_face, how_many)
        in_mode(obj, "EDIT")
        bpy.ops.mesh.delete(type="FACE")
        self.object_mode()
        self.done()

    def select(self, obj, start, how_many):
        """Select faces that follow each other."""
        self.object_mode()
        bpy.context.tool_settings.mesh_select_mode = (False, False, True)
        flags = np.zeros(len(obj.data.polygons), dtype=bool)
        flags[start : start + how_many] = True
        obj.data.vertices.foreach_set("select", np.zeros(len(obj.data.vertices), bool))
        obj.data.edges.foreach_set("select", np.zeros(len(obj.data.edges), bool))
        obj.data.polygons.foreach_set("select", flags)

    @rule(n=NUMBERS)
    def switch_mode(self, n):
        obj = self.body(n)
        in_mode(obj, "OBJECT" if obj.mode == "EDIT" else "EDIT")
        self.done()

    @rule(n=NUMBERS, linked=st.booleans())
    def duplicate(self, n, linked):
        self.object_mode()
        if len(bodies()) < 4:
            self.body(n)
            bpy.ops.object.duplicate(linked=linked)
            bpy.context.active_object.location.x += 3
        self.done()

    @rule(n=NUMBERS, m=NUMBERS)
    def join(self, n, m):
        self.object_mode()
        one, other = self.body(n), self.body(m)
        if one != other and len(one.data.polygons) + len(other.data.polygons) < 400:
            only(one, other)
            bpy.ops.object.join()
        self.done()

    @rule(n=NUMBERS)
    def separate_loose(self, n):
        self.object_mode()
        if len(bodies()) < 4 and self.body(n).data.users == 1:
            bpy.ops.mesh.separate(type="LOOSE")
        self.done()

    @rule(n=NUMBERS, kind=KINDS)
    def apply_modifier(self, n, kind):
        self.object_mode()
        obj = self.body(n)
        if len(obj.data.polygons) < 100 and obj.data.users == 1:
            modifier = obj.modifiers.new("Any", kind)
            bpy.ops.object.modifier_apply(modifier=modifier.name)
        self.done()

    @rule(redo=st.booleans())
    def undo(self, redo):
        attempt(bpy.ops.ed.redo if redo else bpy.ops.ed.undo)

    @rule()
    def flip_normals(self):
        """Make an undo step of Edit Mode, which holds the mesh alone."""
        active = bpy.context.view_layer.objects.active
        if active is not None and active.mode == "EDIT":
            bpy.ops.mesh.flip_normals()
            self.done()

    @rule()
    def save_and_reload(self):
        self.object_mode()
        path = str(self.folder / "restless.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        # Blender refuses to append from the file itself, and to save over a library.
        self.saved = self.folder / f"{len(list(self.folder.iterdir()))}.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(self.saved), copy=True)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.done()

    @rule(n=NUMBERS)
    def append(self, n):
        self.object_mode()
        if not self.saved or len(bodies()) > 3:
            return
        with bpy.data.libraries.load(str(self.saved)) as (there, chosen):
            chosen.objects = [o for o in there.objects if "hull" not in o][:1]
        for obj in chosen.objects:
            bpy.context.collection.objects.link(obj)
        self.done()

    @invariant()
    def all_in_step(self):
        for obj in bodies():
            check_body(obj)

    def teardown(self):
        """Clear all, after which nothing of ours is left."""
        if not hasattr(self, "saved"):
            return
        self.object_mode()
        for obj in bodies(without_faces=True):
            only(obj)
            if bpy.ops.wcd.clear.poll():
                bpy.ops.wcd.clear()
        for obj in bodies(without_faces=True):
            check_cleared(obj)
        check_file_cleared()
