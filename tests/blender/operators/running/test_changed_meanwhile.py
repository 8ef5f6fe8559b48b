"""What a user does while an operator computes: nothing of it is overwritten."""

from types import SimpleNamespace

import bpy
import pytest
import weak_convex_decomposition as package
from edited import record_of
from hand_curves import hand_curve
from hand_made import mesh_object
from snapshot import snapshot
from stand_ins.presses import (
    ESC,
    MOUSE,
    OPERATORS,
    TIMER,
    errors_of,
    finish,
    press,
)
from weak_convex_decomposition.operators.decompose import WCD_OT_decompose
from weak_convex_decomposition.operators.hulls import WCD_OT_build_hulls
from weak_convex_decomposition.operators.measure import WCD_OT_measure
from weak_convex_decomposition.operators.running import modal


def delete():
    bpy.ops.object.delete()


def subdivide():
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide()
    bpy.context.active_object.update_from_editmode()


def load_another_mesh():
    bpy.context.active_object.data = bpy.data.meshes.new("Other")


def edit_another_object():
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.object.mode_set(mode="EDIT")


def sculpt():
    bpy.ops.object.mode_set(mode="SCULPT")


@pytest.mark.parametrize("cls", OPERATORS)
@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (delete, "changed or deleted meanwhile; start again"),
        (subdivide, "changed or deleted meanwhile; start again"),
        (load_another_mesh, "changed or deleted meanwhile; start again"),
        (edit_another_object, "while another object is edited. Start again"),
        (sculpt, "switch the mode. Start again"),
    ],
)
def test_what_changed_meanwhile_is_left_alone(suzanne, window, cls, change, sentence):
    pressed = press(cls, window)
    pressed.modal(None, TIMER)
    change()
    there = [(obj.name, snapshot(obj)) for obj in bpy.data.objects]
    assert finish(pressed) == {"CANCELLED"}
    (error,) = errors_of(pressed)
    assert sentence in error or "Object Mode only; switch the mode" in error
    assert ("WARNING", error) in pressed.reports  # an error would open a popup
    assert [(obj.name, snapshot(obj)) for obj in bpy.data.objects] == there
    assert window.is_clean()


def scale_along_z():
    bpy.context.active_object.scale.z = 3


def apply_scale():
    bpy.ops.object.transform_apply()


def stretch_mesh():
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.transform.resize(value=(1, 1, 3))
    bpy.ops.object.mode_set(mode="OBJECT")


def turn():
    bpy.context.active_object.rotation_euler = (1, 2, 3)
    bpy.context.active_object.location.x = 5


@pytest.mark.parametrize("cls", [WCD_OT_measure, WCD_OT_build_hulls])
@pytest.mark.parametrize("change", [scale_along_z, apply_scale, stretch_mesh])
def test_what_is_found_of_one_shape_is_not_written_to_another(
    suzanne, window, cls, change
):
    suzanne.scale = (1, 2, 1)
    pressed = press(cls, window)
    change()
    assert finish(pressed) == {"CANCELLED"}
    (error,) = errors_of(pressed)
    assert "shape or scale was changed meanwhile; start again" in error
    assert list(bpy.data.objects) == [suzanne]
    assert "wcd" not in suzanne


@pytest.mark.parametrize("cls", OPERATORS)
def test_a_moved_object_has_the_same_shape(suzanne, window, cls):
    suzanne.scale = (1, 2, 3)
    pressed = press(cls, window)
    turn()
    assert finish(pressed) == {"FINISHED"}


@pytest.mark.parametrize("change", [scale_along_z, stretch_mesh])
def test_parts_of_a_shape_that_changed_are_written_without_figures(
    suzanne, window, change
):
    pressed = press(WCD_OT_decompose, window)
    change()
    assert finish(pressed) == {"FINISHED"}
    assert "are the parts that it had before" in pressed.reports[0][1]
    assert {part["convexity_rank"] for part in noted_parts(suzanne)} == {None}
    assert bpy.ops.wcd.refresh_parts() == {"FINISHED"}
    assert None not in {part["convexity_rank"] for part in noted_parts(suzanne)}


def noted_parts(obj):
    return record_of(obj)["parts"]


@pytest.mark.parametrize("factor", [-1, 2])
def test_faces_are_not_cut_where_vertices_moved(window, factor):
    outline = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)]
    vertices = [(x, y, z) for z in (0, 1) for x, y in outline]
    walls = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
    obj = mesh_object("L", vertices, [range(5, -1, -1), range(6, 12), *walls])
    pressed = press(WCD_OT_decompose, window, seams="CUT")
    obj.data.vertices[0].co.x = obj.data.vertices[5].co.x = factor
    assert finish(pressed) == {"CANCELLED"}
    (error,) = errors_of(pressed)
    assert "changed while it was decomposed; start again" in error
    assert (len(obj.data.polygons), obj.data.materials[:]) == (8, [])


def test_a_curve_gets_its_mesh_at_the_end_and_esc_leaves_none(window):
    hand = hand_curve()
    before = [obj.name for obj in bpy.data.objects], len(bpy.data.meshes)
    pressed = press(WCD_OT_decompose, window)
    pressed.modal(None, TIMER)
    assert pressed.modal(None, ESC) == {"CANCELLED"}
    assert ([obj.name for obj in bpy.data.objects], len(bpy.data.meshes)) == before
    pressed = press(WCD_OT_decompose, window)
    assert finish(pressed) == {"FINISHED"}
    (carrier,) = hand.children
    assert carrier.name in bpy.context.scene.objects
    assert len(bpy.data.meshes) == before[1] + 1
    pressed = press(WCD_OT_decompose, window)
    assert bpy.ops.wcd.cancel() == {"FINISHED"}
    assert "CANCELLED" in pressed.modal(None, MOUSE)
    assert hand.children == (carrier,)


def test_a_curve_is_hidden_in_the_scene_that_it_was_read_in(window):
    hand, home = hand_curve(), bpy.context.view_layer
    pressed = press(WCD_OT_decompose, window)
    other = bpy.data.scenes.new("Other")
    with bpy.context.temp_override(scene=other, view_layer=other.view_layers[0]):
        assert finish(pressed) == {"FINISHED"}
    (carrier,) = hand.children
    assert home.objects.active == carrier
    assert (hand.hide_get(view_layer=home), hand.hide_render) == (True, True)
    assert carrier.select_get(view_layer=home)
    assert not hand.select_get(view_layer=home)
    bpy.ops.wcd.clear()
    assert not hand.hide_get()
    assert bpy.context.active_object == hand


def test_undo_meanwhile_is_noticed(suzanne, window):
    bpy.ops.ed.undo_push(message="Suzanne")
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.ed.undo_push(message="Cube")
    pressed = press(WCD_OT_decompose, window)
    bpy.ops.ed.undo()
    assert finish(pressed) == {"CANCELLED"}
    assert "deleted meanwhile" in errors_of(pressed)[0]
    assert "wcd" not in bpy.context.active_object


def test_edit_mode_may_be_entered_meanwhile(suzanne, window):
    pressed = press(WCD_OT_decompose, window)
    bpy.ops.object.mode_set(mode="EDIT")
    assert finish(pressed) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert suzanne.data.attributes["wcd_part"]


def test_another_file_or_a_closed_window_ends_it(suzanne, window):
    pressed = press(WCD_OT_decompose, window)
    pressed.cancel(None)  # as Blender does
    assert window.is_clean()


def test_unregistering_ends_it(suzanne, window):
    press(WCD_OT_decompose, window)
    package.unregister()
    assert window.is_clean()
    package.register()


def test_bad_input_is_told_before_anything_is_started(window):
    bpy.ops.object.add(type="MESH")
    with pytest.raises(AssertionError, match="CANCELLED"):
        press(WCD_OT_decompose, window)
    assert window.is_clean()


def test_our_bugs_leave_nothing_behind(suzanne, window):
    def broken(context):
        yield from ()
        raise ZeroDivisionError

    pressed = press(WCD_OT_measure, window)
    modal.stop()
    context = SimpleNamespace(
        window=window,
        window_manager=window,
        workspace=SimpleNamespace(name="Layout"),
    )
    pressed._running = modal.start(context, "Broken", broken(context))
    with pytest.raises(ZeroDivisionError):
        pressed.modal(None, TIMER)
    assert window.is_clean()
