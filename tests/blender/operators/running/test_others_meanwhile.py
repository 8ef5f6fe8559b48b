"""What waits while something is computed, and what does not."""

from types import SimpleNamespace

import bpy
import pytest
from hand_made import decompose_by_hand
from snapshot import snapshot
from stand_ins.layout import Layout, context
from stand_ins.presses import TIMER, finish, press
from weak_convex_decomposition.operators.decompose import WCD_OT_decompose
from weak_convex_decomposition.operators.recut import WCD_OT_choose_part_count
from weak_convex_decomposition.operators.running import modal
from weak_convex_decomposition.ui.parts_table import WCD_UL_parts

# What only selects, shows, hides or names something, and what belongs to the run.
_GO_ON = {
    *("cancel", "choose_part", "merge_next", "pick_parts", "tell_quality"),
    *("select_parts", "select_boundary", "frame_parts", "isolate_parts"),
    *("explode", "implode", "hide_sight", "show_hulls", "use_preset", "recut"),
    *("rename_part", "rename_parts"),
}


@pytest.fixture
def running(suzanne, window):
    """Suzanne in four parts, with hulls, while she is decomposed."""
    decompose_by_hand(suzanne, 4)
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX")
    pressed = press(WCD_OT_decompose, window)
    pressed.modal(None, TIMER)
    return pressed


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_what_would_change_the_object_waits(running, suzanne, mode):
    bpy.ops.object.mode_set(mode=mode)
    before = snapshot(suzanne)
    for name in set(dir(bpy.ops.wcd)) - _GO_ON:
        with pytest.raises(RuntimeError, match="is running; wait for it, or press Esc"):
            getattr(bpy.ops.wcd, name)()
    assert snapshot(suzanne) == before
    bpy.ops.object.mode_set(mode="OBJECT")
    assert finish(running) == {"FINISHED"}
    assert bpy.ops.wcd.clear() == {"FINISHED"}


@pytest.mark.parametrize(
    "name", ["select_parts", "select_boundary", "isolate_parts", "explode"]
)
def test_what_only_selects_or_shows_does_not_wait(running, name):
    assert getattr(bpy.ops.wcd, name)() == {"FINISHED"}
    assert finish(running) == {"FINISHED"}


def test_names_and_colors_that_are_set_meanwhile_stay(running, suzanne):
    suzanne.wcd_parts[0].name = "Head"
    suzanne.wcd_parts[0].color = (1.0, 0.0, 0.0)
    assert finish(running) == {"FINISHED"}
    row = next(row for row in suzanne.wcd_parts if row.name == "Head")
    assert tuple(row.color) == (1.0, 0.0, 0.0)


def test_a_number_that_was_chosen_is_set_where_it_was(suzanne, window):
    decompose_by_hand(suzanne, 4)
    here, other = bpy.context.scene, bpy.data.scenes.new("Other")
    pressed = press(WCD_OT_choose_part_count, window, parts=3)
    with bpy.context.temp_override(scene=other, view_layer=other.view_layers[0]):
        assert finish(pressed) == {"FINISHED"}
    assert len(suzanne.wcd_parts) == here.wcd.parts == 3
    assert other.wcd.parts == 0


def test_padlocks_wait(running, suzanne):
    def can_lock():
        layout, row = Layout(), suzanne.wcd_parts[0]
        owner = SimpleNamespace(layout=layout)
        WCD_UL_parts.draw_item(
            owner, context(), layout, suzanne, row, 0, suzanne, "", 0
        )
        return {name: free for _, name, free in layout.properties()}["locked"]

    assert not can_lock()
    finish(running)
    assert can_lock()


@pytest.mark.parametrize(
    ("name", "macros"),
    [
        ("TRANSFORM_OT_translate", []),
        ("OBJECT_OT_duplicate_move", ["OBJECT_OT_duplicate", "TRANSFORM_OT_translate"]),
    ],
)
def test_results_wait_while_the_user_moves_something(running, window, name, macros):
    move = SimpleNamespace(
        bl_idname=name, macros=[SimpleNamespace(bl_idname=each) for each in macros]
    )
    picking = SimpleNamespace(bl_idname="WCD_OT_pick_parts", macros=[])
    window.windows = [SimpleNamespace(modal_operators=[picking, move])]
    while not modal.current.job.done:
        running.modal(None, TIMER)
    for _ in range(3):
        assert running.modal(None, TIMER) == {"PASS_THROUGH"}
    window.windows[0].modal_operators.remove(move)
    assert running.modal(None, TIMER) == {"FINISHED"}


def test_a_renamed_workspace_keeps_no_text_of_a_run_that_is_over(running, window):
    workspaces = modal.bpy.data.workspaces
    window.status = "Decompose into Convex Parts: Lines of Sight, 21%"
    workspaces["Mine"] = workspaces.pop("Layout")
    assert finish(running) == {"FINISHED"}
    assert window.is_clean()
