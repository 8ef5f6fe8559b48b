"""A viewport in which parts are picked, without a window."""

from types import SimpleNamespace

import bpy
import pytest
from hand_made import decompose_by_hand
from stand_ins.presses import Pressed, Window
from weak_convex_decomposition.operators.viewport import pick_parts, picking


class Viewport:
    """A stand-in for a viewport in a window, with a part under the cursor or none."""

    def __init__(self, monkeypatch):
        self.under, self.header, self.window = None, None, Window()
        self.workspace, self.statuses = "Layout", {}
        self.region = SimpleNamespace(tag_redraw=lambda: None)
        self.inside = True
        monkeypatch.setattr(
            pick_parts,
            "viewport_at",
            lambda _, x, y: (self.region, x, y) if self.inside else None,
        )
        monkeypatch.setattr(pick_parts, "part_at", lambda *_: self.under)
        monkeypatch.setattr(picking, "show_header", self.show_header)
        monkeypatch.setattr(picking.modal, "_show_status", self.statuses.__setitem__)
        self.pressed = Pressed(pick_parts.WCD_OT_pick_parts)

    def show_header(self, text):
        self.header = text

    @property
    def status(self):
        return self.statuses[self.workspace]

    def start(self):
        answer = self.pressed.invoke(self.context, SimpleNamespace())
        assert answer == {"RUNNING_MODAL"}

    @property
    def context(self):
        return SimpleNamespace(
            active_object=bpy.context.active_object,
            mode=bpy.context.mode,
            window_manager=self.window,
            window=SimpleNamespace(as_pointer=lambda: 1),
            workspace=SimpleNamespace(name=self.workspace),
            scene=bpy.context.scene,
        )

    def event(self, kind, value="PRESS", **keys):
        keys = {"ctrl": False, "alt": False, "shift": False, "oskey": False, **keys}
        event = SimpleNamespace(type=kind, value=value, mouse_x=5, mouse_y=6, **keys)
        return self.pressed.modal(self.context, event)

    def hover(self, obj, number):
        self.under = None if obj is None else (obj, number)
        assert self.event("MOUSEMOVE", "NOTHING") == {"PASS_THROUGH"}


@pytest.fixture
def window():
    """A window with a viewport and no objects, which `seen` looks into."""
    bpy.ops.wm.read_factory_settings(use_empty=False)
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)


@pytest.fixture
def viewport(monkeypatch, suzanne):
    decompose_by_hand(suzanne, 4)
    viewport = Viewport(monkeypatch)
    viewport.start()
    yield viewport
    picking.stop()
