"""Numbers of parts by the wheel: Esc and right-click go back, other presses keep."""

import bpy
import pytest
from hand_made import in_mode
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.parts.read import part_identities
from weak_convex_decomposition.operators.viewport import pick_parts, picking


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("by", ["ESC", "RIGHTMOUSE"])
def test_esc_and_right_click_go_back_to_the_number_before(viewport, by, mode):
    bpy.context.scene.wcd.samples = 100
    suzanne = bpy.context.active_object
    suzanne.wcd_parts[0].name = "Head"
    suzanne.wcd_parts[3].chosen = True
    in_mode(suzanne, mode)
    viewport.hover(suzanne, 2)
    bpy.ops.ed.undo_push(message="before")
    before = snapshot(suzanne) if mode == "OBJECT" else suzanne["wcd"]
    for _ in range(3):
        viewport.event("WHEELUPMOUSE", alt=True)
    viewport.event("PAGE_DOWN")
    assert len(part_identities(suzanne)) == 6
    assert viewport.status.startswith("Click or Enter: keep 6 parts, Esc")
    for kind in ("MIDDLEMOUSE", "NUMPAD_1", "WHEELUPMOUSE", "LEFT_ALT"):
        viewport.event(kind)  # to look at them from another side
    viewport.event("LEFTMOUSE", alt=True)
    assert viewport.status.startswith("Click or Enter: keep 6 parts, Esc")
    viewport.event(by)
    viewport.event(by, "RELEASE")
    suzanne = bpy.context.active_object
    assert (snapshot(suzanne) if mode == "OBJECT" else suzanne["wcd"]) == before
    assert bpy.context.scene.wcd.parts == 0
    assert picking.current is not None
    assert viewport.event("ESC") == {"FINISHED"}


@pytest.mark.parametrize("by", ["RET", "LEFTMOUSE", "TAB"])
def test_whatever_else_is_pressed_keeps_the_number(viewport, suzanne, by):
    bpy.context.scene.wcd.samples = 100
    bpy.ops.ed.undo_push(message="before")
    viewport.event("WHEELUPMOUSE", alt=True)
    viewport.event(by)
    assert viewport.status.endswith("Esc: end")
    assert viewport.event("ESC") == {"FINISHED"}
    assert len(bpy.context.active_object.wcd_parts) == 5


def test_right_click_stops_the_cut_that_runs(viewport, monkeypatch):
    bpy.context.scene.wcd.samples = 100
    bpy.ops.ed.undo_push(message="before")
    viewport.event("WHEELUPMOUSE", alt=True)
    stopped = []
    monkeypatch.setattr(pick_parts.modal, "busy", lambda: None if stopped else "busy")
    monkeypatch.setattr(pick_parts.modal, "stop", lambda: stopped.append(True))
    viewport.event("WHEELUPMOUSE", alt=True)
    viewport.event("RIGHTMOUSE")
    viewport.event("RIGHTMOUSE", "RELEASE")
    assert stopped
    assert len(bpy.context.active_object.wcd_parts) == 4
    viewport.event("MOUSEMOVE", "NOTHING")
    assert len(bpy.context.active_object.wcd_parts) == 4  # the other is not cut later


def test_a_number_that_undo_does_not_reach_is_told(viewport):
    bpy.context.scene.wcd.samples = 100
    edit = bpy.context.preferences.edit
    steps, edit.undo_steps = edit.undo_steps, 2
    bpy.ops.ed.undo_push(message="before")
    for _ in range(5):
        viewport.event("WHEELUPMOUSE", alt=True)
    viewport.event("ESC")
    edit.undo_steps = steps
    assert 4 < len(bpy.context.active_object.wcd_parts) < 9
    assert ("WARNING", "Undo cannot go back to 4 parts") in viewport.pressed.reports
    assert viewport.status.endswith("Esc: end")
