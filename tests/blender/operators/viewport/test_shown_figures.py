"""When the figures that panels draw are counted again: not at each drawing."""

from types import SimpleNamespace

import bmesh
import bpy
import pytest
from hand_made import decompose_by_hand, in_mode
from weak_convex_decomposition.operators.viewport import shown_figures


class Clock:
    """A window's clock and timers, and what is counted meanwhile."""

    def __init__(self):
        self.now, self.timers, self.counts = 0.0, {}, 0

    def perf_counter(self):
        return self.now

    def start_timer(self, function, seconds):
        self.timers.setdefault(function, self.now + seconds)

    def counted(self, obj, after=0.0):
        """Draw after some seconds; return whether that counts the object."""
        bpy.context.view_layer.update()
        self.now += after
        before = self.counts
        shown_figures.shown_figures(obj)
        return self.counts > before


@pytest.fixture
def clock(monkeypatch):
    clock, figures_of = Clock(), shown_figures.figures_of

    def count(obj):
        clock.counts += 1
        return figures_of(obj)

    app = SimpleNamespace(background=False)
    monkeypatch.setattr(shown_figures, "figures_of", count)
    monkeypatch.setattr(shown_figures, "bpy", SimpleNamespace(app=app))
    monkeypatch.setattr(shown_figures, "start_timer", clock.start_timer)
    monkeypatch.setattr(shown_figures, "time", clock)
    monkeypatch.setattr(shown_figures, "_kept", None)
    return clock


def move(obj):
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.verts[0].co.x += 0.1
    bmesh.update_edit_mesh(obj.data)


def test_what_leaves_the_faces_alone_counts_nothing(suzanne, clock):
    decompose_by_hand(suzanne, 3)
    assert clock.counted(suzanne)
    bpy.ops.mesh.primitive_cube_add()
    suzanne.location.x = 1.0
    assert not clock.counted(suzanne, after=60)
    bpy.context.view_layer.objects.active = suzanne
    in_mode(suzanne, "EDIT")
    assert clock.counted(suzanne)
    bpy.ops.mesh.select_all(action="INVERT")
    assert not clock.counted(suzanne, after=60)
    move(suzanne)
    assert clock.counted(suzanne)
    in_mode(suzanne, "OBJECT")
    assert clock.counted(suzanne)
    decompose_by_hand(suzanne, 2)
    assert clock.counted(suzanne)


def test_what_changes_soon_is_counted_and_drawn_later(suzanne, clock):
    decompose_by_hand(suzanne, 3)
    in_mode(suzanne, "EDIT")
    assert clock.counted(suzanne)
    move(suzanne)
    assert not clock.counted(suzanne, after=0.1)
    ((draw, then),) = clock.timers.items()
    assert draw == shown_figures.redraw
    assert clock.counted(suzanne, after=then - clock.now)


def test_large_meshes_in_edit_mode_are_counted_at_rest(suzanne, clock, monkeypatch):
    monkeypatch.setattr(shown_figures, "_MANY", 100)
    decompose_by_hand(suzanne, 3)
    assert clock.counted(suzanne)
    clock.now = 60.0
    in_mode(suzanne, "EDIT")
    assert not clock.counted(suzanne)
    for _ in range(5):
        move(suzanne)
        assert not clock.counted(suzanne)
        assert not clock.counted(suzanne, after=0.4)
    assert clock.counted(suzanne, after=0.2)
    bpy.ops.mesh.select_all(action="INVERT")
    assert not clock.counted(suzanne, after=60)
    in_mode(suzanne, "OBJECT")
    assert clock.counted(suzanne)
