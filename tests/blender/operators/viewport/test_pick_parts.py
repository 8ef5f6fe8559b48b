"""Pick Parts: what hovering, clicks, keys and the wheel do, and that all ends clean."""

from types import SimpleNamespace

import bmesh
import bpy
import pytest
from hand_made import activate, decompose_by_hand, in_mode
from snapshot import snapshot
from weak_convex_decomposition.operators.viewport import pick_parts, picking


def delete_faces(obj, number):
    """Delete the faces of a part of an object in Edit Mode."""
    mesh = bmesh.from_edit_mesh(obj.data)
    layer = mesh.faces.layers.int["wcd_part"]
    gone = [face for face in mesh.faces if face[layer] == number]
    bmesh.ops.delete(mesh, geom=gone, context="FACES")
    bmesh.update_edit_mesh(obj.data)


def rows(obj):
    return obj.wcd_active_part, [row.chosen for row in obj.wcd_parts]


def test_hovering_names_the_part_and_changes_nothing(viewport, suzanne):
    before = snapshot(suzanne)
    viewport.hover(suzanne, 2)
    assert picking.current.part().name == "Part 03"
    assert viewport.header == "Pick Parts  |  Part 03  |  Suzanne: 4 Parts"
    viewport.hover(None, 0)
    assert picking.current.part() is None
    assert viewport.header == "Pick Parts  |  Suzanne: 4 Parts"
    assert snapshot(suzanne) == before
    assert viewport.event("ESC") == {"FINISHED"}
    assert viewport.header is viewport.status is picking.current is None
    assert snapshot(suzanne) == before


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_the_header_counts_the_parts_that_are_there(viewport, suzanne, mode):
    in_mode(suzanne, "EDIT")
    delete_faces(suzanne, suzanne.wcd_parts[3].number)
    in_mode(suzanne, mode)
    viewport.event("TIMER")
    assert viewport.header == "Pick Parts  |  Suzanne: 3 Parts"
    assert viewport.event("WHEELUPMOUSE", alt=True) == {"RUNNING_MODAL"}
    assert (
        viewport.status == "Click or Enter: keep 4 parts, Esc or Right-Click: back to 3"
    )


def test_the_keys_are_told_where_picking_goes_on(viewport):
    viewport.workspace = "Modeling"
    viewport.event("TIMER")
    assert viewport.status.startswith("Click: choose")
    assert viewport.statuses["Layout"] is None
    viewport.event("ESC")
    assert set(viewport.statuses.values()) == {None}


def test_the_header_counts_at_once_what_was_written(viewport, suzanne):
    viewport.event("TIMER")
    decompose_by_hand(suzanne, 2)  # Blender has shown nothing of it yet
    viewport.event("TIMER")
    assert viewport.header == "Pick Parts  |  Suzanne: 2 Parts"


def test_the_header_counts_joined_parts(viewport, suzanne):
    bpy.ops.mesh.primitive_cube_add(location=(4, 0, 0))
    cube = bpy.context.active_object
    decompose_by_hand(cube, 3)
    activate(suzanne)
    cube.select_set(True)
    viewport.hover(suzanne, 0)
    bpy.ops.object.join()
    viewport.hover(suzanne, 0)
    assert viewport.header == "Pick Parts  |  Part 01  |  Suzanne: 7 Parts"


def test_clicks_choose_and_add(viewport, suzanne):
    viewport.hover(suzanne, 2)
    assert viewport.event("LEFTMOUSE") == {"RUNNING_MODAL"}
    assert rows(suzanne) == (2, [False] * 4)
    viewport.hover(suzanne, 0)
    viewport.event("LEFTMOUSE", shift=True)
    assert rows(suzanne) == (0, [True, False, True, False])
    viewport.event("LEFTMOUSE", shift=True)
    assert rows(suzanne) == (2, [False] * 4)
    viewport.hover(None, 0)
    assert viewport.event("LEFTMOUSE") == {"RUNNING_MODAL"}
    assert rows(suzanne) == (2, [False] * 4)


def test_a_click_makes_another_object_active(viewport, suzanne):
    bpy.ops.mesh.primitive_cube_add(location=(4, 0, 0))
    cube = bpy.context.active_object
    decompose_by_hand(cube, 2)
    viewport.hover(suzanne, 3)
    viewport.event("LEFTMOUSE")
    assert bpy.context.active_object == suzanne
    assert (suzanne.select_get(), cube.select_get()) == (True, False)
    assert suzanne.wcd_active_part == 3


def test_each_choice_is_one_undo_step(viewport, suzanne):
    bpy.ops.ed.undo_push(message="before")
    for number in (1, 2):
        viewport.hover(bpy.context.active_object, number)
        viewport.event("LEFTMOUSE")
    for number in (1, 0):
        bpy.ops.ed.undo()
        assert bpy.context.active_object.wcd_active_part == number
    viewport.hover(bpy.context.active_object, 3)  # picking goes on
    assert picking.current.part().name == "Part 04"


def test_what_is_not_ours_passes(viewport, suzanne):
    viewport.hover(suzanne, 2)
    for kind in ("MIDDLEMOUSE", "NUMPAD_1", "WHEELUPMOUSE", "TAB", "TIMER", "Z"):
        assert viewport.event(kind) == {"PASS_THROUGH"}, kind
    assert viewport.event("W", ctrl=True) == {"PASS_THROUGH"}
    for key in ("alt", "ctrl"):  # Alt may emulate the middle button
        assert viewport.event("LEFTMOUSE", **{key: True}) == {"PASS_THROUGH"}
        assert viewport.event("RIGHTMOUSE", **{key: True}) == {"PASS_THROUGH"}
    assert viewport.event("LEFTMOUSE", "RELEASE") == {"PASS_THROUGH"}
    viewport.inside = False  # over the sidebar
    for kind in ("LEFTMOUSE", "RIGHTMOUSE", "W", "PAGE_UP"):
        assert viewport.event(kind) == {"PASS_THROUGH"}, kind
    assert rows(suzanne) == (0, [False] * 4)


def test_the_wheel_changes_the_number_of_parts(viewport, suzanne):
    bpy.context.scene.wcd.samples = 100
    assert viewport.event("WHEELUPMOUSE", alt=True) == {"RUNNING_MODAL"}
    assert len(suzanne.wcd_parts) == 5
    viewport.event("WHEELDOWNMOUSE", alt=True)
    viewport.event("PAGE_DOWN")
    assert len(suzanne.wcd_parts) == 3
    assert bpy.context.scene.wcd.parts == 3


def test_the_menu_acts_on_the_part_under_the_cursor(viewport, suzanne, monkeypatch):
    opened = []
    ops = SimpleNamespace(
        wm=SimpleNamespace(call_menu_pie=lambda *_, name: opened.append(name)),
        wcd=bpy.ops.wcd,
    )
    monkeypatch.setattr(pick_parts, "bpy", SimpleNamespace(ops=ops))
    viewport.hover(suzanne, 1)
    assert viewport.event("RIGHTMOUSE") == {"RUNNING_MODAL"}
    assert not opened
    assert viewport.event("RIGHTMOUSE", "RELEASE") == {"RUNNING_MODAL"}
    assert rows(suzanne) == (1, [False] * 4)
    viewport.hover(suzanne, 3)
    viewport.event("LEFTMOUSE", shift=True)
    assert viewport.event("W") == {"RUNNING_MODAL"}
    assert rows(suzanne) == (3, [False, True, False, True])  # ticks stay
    assert opened == ["WCD_MT_pick"] * 2
    viewport.hover(None, 0)
    viewport.event("RIGHTMOUSE")
    assert viewport.event("RIGHTMOUSE", "RELEASE") == {"FINISHED"}
    assert picking.current is None


def test_merging_waits_for_the_next_click(viewport, suzanne):
    viewport.hover(suzanne, 1)
    viewport.event("LEFTMOUSE")
    assert bpy.ops.wcd.merge_next() == {"FINISHED"}
    assert viewport.event("ESC") == {"RUNNING_MODAL"}  # leaves the merge alone
    bpy.ops.wcd.merge_next()
    viewport.event("LEFTMOUSE")  # not with itself
    assert len(suzanne.wcd_parts) == 4
    viewport.hover(suzanne, 3)
    viewport.event("LEFTMOUSE")
    assert [row.name for row in suzanne.wcd_parts] == ["Part 01", "Part 02", "Part 03"]
    assert not picking.current.merging


def test_picking_ends_with_the_file_and_by_its_button(viewport, suzanne, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "parts.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "parts.blend"))
    assert picking.current is None
    assert viewport.header is None
    assert viewport.event("MOUSEMOVE") == {"FINISHED", "PASS_THROUGH"}
    viewport.start()
    assert viewport.pressed.invoke(viewport.context, None) == {"FINISHED"}
    assert picking.current is None


@pytest.mark.parametrize("mode", ["SCULPT", "WEIGHT_PAINT"])
def test_picking_leaves_clicks_to_other_modes(viewport, suzanne, mode):
    viewport.hover(suzanne, 2)
    in_mode(suzanne, "EDIT")
    assert viewport.event("LEFTMOUSE") == {"RUNNING_MODAL"}
    in_mode(suzanne, mode)
    assert viewport.event("LEFTMOUSE") == {"FINISHED", "PASS_THROUGH"}
    assert viewport.header is viewport.status is picking.current is None
    assert rows(suzanne) == (2, [False] * 4)


def test_picking_needs_parts_and_a_viewport(suzanne):
    with pytest.raises(RuntimeError, match="There is no 3D viewport here"):
        bpy.ops.wcd.pick_parts("INVOKE_DEFAULT")


def test_an_object_outside_the_view_layer_is_refused_in_a_sentence(suzanne):
    decompose_by_hand(suzanne, 3)
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.collection.objects.unlink(suzanne)
    with pytest.raises(RuntimeError, match="Suzanne is not in the view layer; link it"):
        bpy.ops.wcd.choose_part(object="Suzanne", number=1)
    assert suzanne.wcd_active_part == 0


def test_a_name_that_no_object_has_is_refused(suzanne):
    decompose_by_hand(suzanne, 3)
    with pytest.raises(RuntimeError, match="There is no object Nobody"):
        bpy.ops.wcd.choose_part(object="Nobody", number=1)
    assert suzanne.wcd_active_part == 0


def test_parts_are_locked_and_renamed(suzanne):
    decompose_by_hand(suzanne, 3)
    suzanne.wcd_parts[0].locked = True
    suzanne.wcd_parts[0].chosen = suzanne.wcd_parts[2].chosen = True
    bpy.ops.wcd.lock_parts()
    assert [row.locked for row in suzanne.wcd_parts] == [True, False, True]
    bpy.ops.wcd.lock_parts()
    assert not any(row.locked for row in suzanne.wcd_parts)
    suzanne.wcd_active_part = 1
    bpy.ops.wcd.rename_part(name=" Ear ")
    assert suzanne.wcd_parts[1].name == "Ear"
    assert "Ear" in suzanne.vertex_groups
    with pytest.raises(RuntimeError, match=r"is still Ear\.$"):
        bpy.ops.wcd.rename_part(name="Part 01")
    assert suzanne.wcd_parts[1].name == "Ear"
    suzanne.vertex_groups.new(name="Horn")
    assert bpy.ops.wcd.rename_part(name="Horn") == {"FINISHED"}
    assert suzanne.wcd_parts[1].name == "Horn.001"
