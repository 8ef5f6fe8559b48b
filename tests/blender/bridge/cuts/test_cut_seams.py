"""Faces cut along seams: what cuts keep, and the way back."""

import re

import bpy
import numpy as np
import pytest
from edited import check_in_step
from hand_made import activate, areas, in_mode
from headless.command import run_wcd
from random_work.low_poly import check_kept, figures, low_poly
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.cuts.whole_mesh import (
    edited_since_cut,
    is_cut,
)
from weak_convex_decomposition.operators.bridge.stored.record import record_of

FAST = {"samples": 200, "containers": "HOLLOW", "max_parts": 4}


def cut(seams="CUT", **changes):
    assert bpy.ops.wcd.decompose(**{**FAST, "seams": seams, **changes}) == {"FINISHED"}


@pytest.mark.parametrize("seed", [1, 4, 6, 9, 15, 19])
def test_cuts_keep_the_shape_and_all_layers_and_clear_is_exact(seed):
    obj = low_poly(seed)
    before, known, n_faces = snapshot(obj), figures(obj), len(obj.data.polygons)
    cut()
    assert len(obj.data.polygons) > n_faces
    check_kept(obj, known, n_faces)
    check_in_step(obj)
    bpy.ops.wcd.clear()
    assert snapshot(obj) == before


def test_the_caps_of_an_angle_are_divided_between_its_arms(angle):
    cut(parts=2)
    mesh = angle.data
    parts = np.array([each.value for each in mesh.attributes["wcd_part"].data])
    arms = np.bincount(parts, areas(mesh))
    assert arms.min() > 0.35 * arms.sum()
    for side in (0, 1):
        flat = [
            p for p in mesh.polygons if abs(p.normal.z) > 0.9 and p.center.z == side
        ]
        assert {parts[p.index] for p in flat} == {0, 1}
    assert len(mesh.polygons) == 11


def test_faces_stay_whole_by_default_and_a_note_names_the_remedy(angle):
    before = snapshot(angle)["mesh"]["vertices"]
    cut("KEEP")
    assert snapshot(angle)["mesh"]["vertices"] == before
    assert len(angle.data.polygons) == 8
    assert not is_cut(angle)
    assert "Cut Faces" in angle["wcd"]
    cut()
    assert "Cut Faces" not in angle["wcd"]


def test_a_new_run_starts_from_the_whole_faces(angle):
    before = snapshot(angle)
    cut()
    first = snapshot(angle)["mesh"]
    bpy.ops.wcd.smooth_seams()
    cut()
    second = snapshot(angle)["mesh"]
    assert [first[k] == second[k] for k in ("vertices", "edges")] == [True, True]
    cut("KEEP", parts=3)
    assert len(angle.data.polygons) == 8
    assert not is_cut(angle)
    cut()
    assert snapshot(angle)["mesh"]["vertices"] == first["vertices"]
    bpy.ops.wcd.clear()
    assert snapshot(angle) == before


def test_parts_keep_their_names_and_colors_in_a_new_run(angle):
    cut(parts=2)
    angle.wcd_parts[1].name, angle.wcd_parts[1].color = "Arm", (0.1, 0.2, 0.3)
    cut(parts=2, alpha=1.0)
    assert angle.wcd_parts[1].name == "Arm"
    assert tuple(angle.wcd_parts[1].color) == pytest.approx((0.1, 0.2, 0.3))
    check_in_step(angle)


def test_cuts_of_an_edited_mesh_stay_and_that_is_said_beforehand(angle):
    cut()
    n_faces = len(angle.data.polygons)
    in_mode(angle, "EDIT")
    in_mode(angle, "OBJECT")
    assert not edited_since_cut(angle)
    angle.data.vertices[0].co.x += 0.1
    assert edited_since_cut(angle)
    said = bpy.types.WCD_OT_clear.description(bpy.context, None)
    assert "the cuts stay" in said
    bpy.ops.wcd.clear()
    assert len(angle.data.polygons) == n_faces
    assert [mesh.name for mesh in bpy.data.meshes if mesh.users] == ["L"]
    assert not [each.name for each in angle.data.attributes if "wcd" in each.name]
    assert not [key for key in angle.data.keys() if "wcd" in key]  # noqa: SIM118


def test_clear_takes_back_seams_that_were_marked_before_the_cuts(angle):
    before = snapshot(angle)
    cut(seams="KEEP", parts=2)
    bpy.ops.wcd.mark_seams()
    cut(parts=2)
    bpy.ops.wcd.clear()
    assert snapshot(angle) == before


def test_materials_given_since_are_an_edit_and_selecting_is_none(angle):
    angle.data.materials.append(bpy.data.materials.new("Own"))
    cut()
    angle.data.polygons[0].select = not angle.data.polygons[0].select
    assert not edited_since_cut(angle)
    angle.data.polygons[0].material_index = 0
    assert not edited_since_cut(angle)  # it was there before
    angle.data.materials.append(bpy.data.materials.new("New"))
    assert edited_since_cut(angle)


def test_faces_are_cut_in_object_mode_only(angle):
    in_mode(angle, "EDIT")
    with pytest.raises(RuntimeError, match="Object Mode only"):
        cut()
    in_mode(angle, "OBJECT")
    cut()
    in_mode(angle, "EDIT")
    assert not bpy.ops.wcd.clear.poll()


def test_objects_that_share_a_mesh_are_cut_and_cleared_together(angle):
    other = bpy.data.objects.new("Other", angle.data)
    bpy.context.collection.objects.link(other)
    before = snapshot(angle)
    cut()
    assert other.data == angle.data
    assert is_cut(other)
    bpy.ops.wcd.clear()
    assert other.data == angle.data
    assert snapshot(angle) == before


def test_a_copy_of_a_cut_object_is_cleared_on_its_own(angle):
    mesh = snapshot(angle)["mesh"]
    cut()
    bpy.ops.object.duplicate()
    copy = bpy.context.active_object
    for obj in (copy, angle):
        activate(obj)
        bpy.ops.wcd.clear()
        assert snapshot(obj)["mesh"] == mesh
    assert copy.data != angle.data


def test_copies_of_a_cut_object_get_whole_faces_each(angle):
    cut(parts=2)
    bpy.ops.object.duplicate()
    copy = bpy.context.active_object
    for obj, parts in ((copy, 1), (angle, 2)):
        activate(obj)
        cut("KEEP", parts=parts)
    assert copy.data != angle.data
    check_in_step(copy)
    check_in_step(angle)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_an_object_that_cut_faces_were_joined_to_is_cleared_of_them(angle, mode):
    cut(parts=2)
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    cut("KEEP", parts=1)
    angle.select_set(True)
    bpy.ops.object.join()
    in_mode(cube, mode)
    bpy.ops.wcd.clear()
    in_mode(cube, "OBJECT")
    assert not [a.name for a in cube.data.attributes if a.name.startswith("wcd")]


def test_the_whole_faces_are_saved_with_the_file(angle, tmp_path):
    before = snapshot(angle)["mesh"]
    cut()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "cut.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "cut.blend"))
    bpy.ops.wcd.clear()
    assert snapshot(bpy.data.objects["L"])["mesh"] == before


def test_undo_takes_the_cuts_back_in_one_step(angle):
    bpy.ops.ed.undo_push(message="before")
    before = snapshot(angle)
    cut()
    bpy.ops.ed.undo_push(message="cut")
    bpy.ops.ed.undo()
    assert snapshot(bpy.data.objects["L"]) == before


def test_separate_objects_have_the_cut_faces_and_no_way_back(angle):
    cut(parts=2)
    total = areas(angle.data).sum()
    bpy.ops.wcd.separate()
    pieces = list(bpy.data.collections["L parts"].objects)
    assert sum(areas(piece.data).sum() for piece in pieces) == pytest.approx(total)
    assert not any(map(is_cut, pieces))
    assert not [a.name for p in pieces for a in p.data.attributes if "wcd" in a.name]


def test_locked_parts_keep_their_faces(angle):
    cut(parts=2)
    vertices = snapshot(angle)["mesh"]["vertices"]
    angle.wcd_parts[0].locked = True
    cut(parts=3)
    assert snapshot(angle)["mesh"]["vertices"] == vertices
    assert "No more faces were cut" in angle["wcd"]


def test_a_stretched_object_is_cut_as_it_is_seen(angle):
    angle.scale = (1, 3, 1)
    bpy.context.view_layer.update()
    before = snapshot(angle)
    cut(parts=2)
    assert is_cut(angle)
    bpy.ops.wcd.clear()
    assert snapshot(angle) == before


def test_the_command_line_writes_the_cut_faces(angle, tmp_path):
    source, output = tmp_path / "l.blend", tmp_path / "l.obj"
    bpy.ops.wm.save_as_mainfile(filepath=str(source))
    options = ["--samples", "200", "--parts", "2", "--seams", "cut", "--quiet"]
    assert run_wcd(source, "--output", output, *options) == 0
    lines = output.read_text(encoding="utf-8").splitlines()
    assert sum(line.startswith("f ") for line in lines) == 11


def test_parts_within_a_face_are_left_out_with_a_note():
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.wcd.decompose(parts=4, seams="CUT")
    obj = bpy.context.object
    (note,) = record_of(obj)["notes"]
    words = r"(\d) parts? (?:is a|are) mere patch(?:es)? within a face, and left out"
    assert int(re.match(words, note)[1]) == 4 - len(obj.wcd_parts) > 0
