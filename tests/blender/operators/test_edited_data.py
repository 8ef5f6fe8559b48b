"""Edited parts: locks, names, undo, Clear, files, and what is refused."""

import bpy
import pytest
from edited import FAST, check_in_step, labels_of, parts_of, record_of
from hand_made import (
    decompose_by_hand,
    give_user_data,
    in_mode,
    mesh_object,
)
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.parts.renaming import (
    UNSET,
    recolor_part,
)

MODES = pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
EDITS = {
    "merge_parts": {},
    "split_parts": {"parts": 2},
    "smooth_seams": {"scope": "ALL", "smoothness": 20.0},
    "mirror_parts": {"direction": "TO_NEGATIVE"},
}


def test_a_new_decomposition_keeps_locked_parts(monkey):
    labels, before = labels_of(monkey), parts_of(monkey)
    monkey.wcd_parts[0].name = "Left"
    monkey.wcd_parts[0].locked = monkey.wcd_parts[3].locked = True
    assert bpy.ops.wcd.decompose(**FAST, parts=5) == {"FINISHED"}
    assert len(parts_of(monkey)) == 5
    parts = {name: index for index, (name, _, _) in enumerate(parts_of(monkey))}
    now = labels_of(monkey)
    assert (now == parts["Left"]).tolist() == (labels == 0).tolist()
    assert (now == parts[before[3][0]]).tolist() == (labels == 3).tolist()
    assert {row.name for row in monkey.wcd_parts if row.locked} == {"Left", "Part 04"}
    assert record_of(monkey)["parameters"]["parts"] == 5
    check_in_step(monkey)


def test_a_color_that_is_reset_is_free(monkey):
    """As the key for Reset to Default Value over a swatch asks for."""
    colors = [row.color[:] for row in monkey.wcd_parts]
    monkey.wcd_parts[2].color = (1, 0, 0)
    recolor_part(monkey, 2, UNSET)
    assert [row.color[:] for row in monkey.wcd_parts] == colors
    monkey.wcd_parts[0].color = colors[1]
    recolor_part(monkey, 1, UNSET)
    assert monkey.wcd_parts[1].color[:] == colors[0]


def test_a_new_name_reaches_the_objects_that_share_the_mesh(monkey):
    twin, other = monkey.copy(), bpy.data.objects.new("Other", monkey.data)
    monkey.wcd_parts[1].name = "Ear.L"
    assert twin.wcd_parts[1].name == record_of(twin)["parts"][1]["name"] == "Ear.L"
    assert record_of(twin)["parts"] == record_of(monkey)["parts"]
    assert "wcd" not in other
    twin.wcd_parts[1].name = "Horn"
    assert "Horn" in monkey.vertex_groups
    check_in_step(monkey)


def test_after_clear_names_and_colors_begin_anew(monkey):
    monkey.wcd_parts[0].name = "Left"
    bpy.ops.wcd.clear()
    bpy.ops.wcd.decompose(**FAST, parts=2)
    assert [name for name, _, _ in parts_of(monkey)] == ["Part 01", "Part 02"]
    assert not any(row.chosen or row.locked for row in monkey.wcd_parts)


@MODES
def test_a_new_name_goes_to_group_material_and_record(monkey, mode):
    other = monkey.copy()
    other.data = monkey.data.copy()
    in_mode(monkey, mode)
    monkey.wcd_parts[1].name = "Ear.L"
    assert parts_of(monkey)[1] == ("Ear.L", 1, "Ear.L")
    assert "Ear.L" in monkey.vertex_groups
    assert [m.name for m in other.data.materials][1] == "Part 02"
    check_in_step(monkey)
    in_mode(monkey, "OBJECT")
    monkey.wcd_parts[0].chosen = True
    monkey.wcd_parts[2].chosen = False
    bpy.ops.wcd.merge_parts()
    assert parts_of(monkey)[0] == ("Ear.L", 1, "Ear.L")
    check_in_step(monkey)


@pytest.mark.parametrize("name", ["", "  ", "Part 03"])
def test_names_that_cannot_be_are_taken_back(monkey, name):
    before = parts_of(monkey)
    monkey.wcd_parts[1].name = name
    assert monkey.wcd_parts[1].name == "Part 02"
    assert parts_of(monkey) == before


@pytest.mark.parametrize("name", EDITS)
def test_every_edit_is_one_undo_step(monkey, name):
    before = snapshot(monkey)
    bpy.ops.ed.undo_push(message="before")
    getattr(bpy.ops.wcd, name)("EXEC_DEFAULT", True, **EDITS[name])
    after = snapshot(bpy.context.active_object)
    assert after != before
    bpy.ops.ed.undo()
    assert snapshot(bpy.context.active_object) == before
    bpy.ops.ed.redo()
    assert snapshot(bpy.context.active_object) == after


@pytest.mark.parametrize("name", EDITS)
def test_clear_brings_the_users_data_back_after_an_edit(suzanne, name):
    give_user_data(suzanne)
    before = snapshot(suzanne)
    decompose_by_hand(suzanne, 4, **FAST)
    suzanne.wcd_parts[1].chosen = suzanne.wcd_parts[2].chosen = True
    suzanne.wcd_parts[1].name = "Named"
    getattr(bpy.ops.wcd, name)(**EDITS[name])
    bpy.ops.wcd.clear()
    assert snapshot(suzanne) == before
    assert not [key for key in suzanne.keys() if "wcd" in key]  # noqa: SIM118 - no dict


def test_parts_and_rows_are_in_a_saved_file(monkey, tmp_path):
    monkey.wcd_parts[0].name, monkey.wcd_parts[0].locked = "Left", True
    bpy.ops.wcd.merge_parts()
    before = snapshot(monkey)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    (obj,) = bpy.data.objects
    bpy.context.view_layer.objects.active = obj
    assert snapshot(obj) == before
    check_in_step(obj)
    assert bpy.ops.wcd.split_parts(parts=2) == {"FINISHED"}
    assert obj.wcd_parts[0].locked


def test_faces_deleted_meanwhile_are_no_hindrance(monkey):
    in_mode(monkey, "EDIT")
    bpy.ops.mesh.select_mode(type="FACE")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.wcd.select_parts()
    bpy.ops.mesh.delete(type="FACE")
    in_mode(monkey, "OBJECT")
    assert bpy.ops.wcd.smooth_seams(scope="ALL") == {"FINISHED"}
    assert [name for name, _, _ in parts_of(monkey)] == ["Part 01", "Part 04"]
    check_in_step(monkey)


def test_what_cannot_be_done_is_said_in_a_sentence(monkey):
    poll, say = RuntimeError, pytest.raises
    with say(poll, match="One part is no split"):
        bpy.ops.wcd.split_parts(parts=1)
    monkey.wcd_parts[2].chosen = False
    with say(poll, match="Tick two or more"):
        bpy.ops.wcd.merge_parts()
    with say(poll, match="Faces are selected in Edit Mode"):
        bpy.ops.wcd.assign_faces()
    in_mode(monkey, "EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    with say(poll, match="No face is selected"):
        bpy.ops.wcd.assign_faces()
    in_mode(monkey, "OBJECT")
    for row in monkey.wcd_parts:
        row.locked = True
    with say(poll, match="All parts are locked"):
        bpy.ops.wcd.decompose(**FAST)
    monkey.wcd_parts[0].locked = False
    with say(poll, match="but 3 parts are locked, which counts too; raise it to 4"):
        bpy.ops.wcd.decompose(**FAST, parts=3)
    bpy.ops.wcd.clear()
    with say(poll, match="has no parts yet"):
        bpy.ops.wcd.merge_parts()


def test_a_shape_without_symmetry_is_not_mirrored(monkey):
    monkey.data.transform(monkey.matrix_world.Translation((5.0, 0.0, 0.0)))
    before = snapshot(monkey)
    with pytest.raises(RuntimeError, match="not symmetric"):
        bpy.ops.wcd.mirror_parts()
    assert snapshot(monkey) == before


def test_points_have_parts_that_can_be_merged():
    bpy.ops.mesh.primitive_uv_sphere_add()
    points = [tuple(v.co) for v in bpy.context.active_object.data.vertices]
    points += [(x + 3, y, z) for x, y, z in points]
    obj = mesh_object("Points", points, [])
    bpy.ops.wcd.decompose(**FAST, parts=3)
    count = len(parts_of(obj))
    assert count >= 2
    colors = {part[1]: None for part in parts_of(obj)}
    obj.wcd_parts[0].chosen = obj.wcd_parts[1].chosen = True
    assert bpy.ops.wcd.merge_parts() == {"FINISHED"}
    assert len(parts_of(obj)) == count - 1
    assert {part[1] for part in parts_of(obj)} <= set(colors)
    with pytest.raises(RuntimeError, match="has no faces, only points"):
        bpy.ops.wcd.select_parts()
    with pytest.raises(RuntimeError, match="has no faces, only points"):
        bpy.ops.wcd.assign_faces()


def test_hulls_of_former_parts_are_not_taken_for_those_of_new_ones(monkey):
    bpy.ops.wcd.build_hulls(pieces="PARTS")
    hulls = record_of(monkey)["hulls"]["hulls"]
    assert {hull["part"] for hull in hulls} == {0, 1, 2, 3}
    bpy.ops.wcd.merge_parts()
    hulls = record_of(monkey)["hulls"]["hulls"]
    assert [hull["part"] for hull in hulls] == [None] * len(hulls)


def test_a_material_that_another_object_uses_keeps_its_color_and_name(monkey):
    material = monkey.data.materials[0]
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.active_object.data.materials.append(material)
    before = material.name, tuple(material.diffuse_color)
    monkey.wcd_parts[0].color = (1, 0, 0)
    monkey.wcd_parts[0].name = "Ear"
    assert (material.name, tuple(material.diffuse_color)) == before
    assert tuple(monkey.wcd_parts[0].color) == (1, 0, 0)
