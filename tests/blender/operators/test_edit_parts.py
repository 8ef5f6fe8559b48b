"""Parts changed by hand: what changes, what stays, and that it can be undone."""

import json

import bpy
import numpy as np
import pytest
from hand_made import (
    decompose_by_hand,
    decomposition_of,
    face_values,
    give_user_data,
    in_mode,
    mesh_object,
)
from snapshot import snapshot
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.operators.bridge.mesh.selection import select_faces
from weak_convex_decomposition.operators.bridge.parts.write import write_parts

# Of the visibility that edits are described by.
FAST = {"samples": 60, "containers": "HOLLOW", "max_parts": 4}
MODES = pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
EDITS = {
    "merge_parts": {},
    "split_parts": {"parts": 2},
    "smooth_seams": {"scope": "ALL", "smoothness": 20.0},
    "mirror_parts": {"direction": "TO_NEGATIVE"},
}


@pytest.fixture
def monkey(suzanne):
    """Suzanne with four bands along x as parts, the second and third ticked."""
    decompose_by_hand(suzanne, 4, **FAST)
    suzanne.wcd_parts[1].chosen = suzanne.wcd_parts[2].chosen = True
    suzanne.wcd_active_part = 1
    return suzanne


def labels_of(obj):
    mode = obj.mode
    in_mode(obj, "OBJECT")
    labels = face_values(obj.data, "wcd_part")
    in_mode(obj, mode)
    return labels


def record_of(obj):
    return json.loads(obj["wcd"])


def parts_of(obj):
    """Return the name, number and material of each part, from the record."""
    keys = ("name", "number", "material")
    return [tuple(part[key] for key in keys) for part in record_of(obj)["parts"]]


def check_in_step(obj):
    """Check that groups, slots, faces, rows and record tell of the same parts."""
    mode = obj.mode
    in_mode(obj, "OBJECT")
    record, labels = record_of(obj), labels_of(obj)
    names = [part["name"] for part in record["parts"]]
    assert record["k"] == len(names) == len(set(names))
    assert [row.name for row in obj.wcd_parts] == names
    assert [row.number for row in obj.wcd_parts] == [n for _, n, _ in parts_of(obj)]
    assert set(names) <= {group.name for group in obj.vertex_groups}
    counts = np.bincount(labels, minlength=len(names))
    assert [part["faces"] for part in record["parts"]] == counts.tolist()
    assert sum(part["faces"] for part in record["parts"]) == len(labels)
    belongs = {(names[i], v) for f, i in enumerate(labels) for v in vertices_of(obj, f)}
    groups = {group.index: group.name for group in obj.vertex_groups}
    weights = {(groups[g.group], v.index) for v in obj.data.vertices for g in v.groups}
    assert {pair for pair in weights if pair[0] in names} == belongs
    slots = [obj.data.materials[p.material_index].name for p in obj.data.polygons]
    assert slots == [record["parts"][index]["material"] for index in labels]
    in_mode(obj, mode)


def vertices_of(obj, face):
    return obj.data.polygons[face].vertices


@MODES
def test_merged_parts_are_one_and_the_others_stay(monkey, mode):
    before, labels, record = parts_of(monkey), labels_of(monkey), record_of(monkey)
    in_mode(monkey, mode)
    assert bpy.ops.wcd.merge_parts() == {"FINISHED"}
    assert monkey.mode == mode
    assert parts_of(monkey) == [before[0], before[1], before[3]]
    assert (labels_of(monkey) == np.array([0, 1, 1, 2])[labels]).all()
    ranks = [part["convexity_rank"] for part in record["parts"]]
    merged = [part["convexity_rank"] for part in record_of(monkey)["parts"]]
    assert merged[1] != ranks[1]
    assert record_of(monkey)["parameters"] == record["parameters"]
    check_in_step(monkey)


@MODES
def test_a_split_leaves_the_other_parts_alone(monkey, mode):
    before, labels = parts_of(monkey), labels_of(monkey)
    monkey.wcd_parts[2].chosen = False
    in_mode(monkey, mode)
    assert bpy.ops.wcd.split_parts(parts=3) == {"FINISHED"}
    assert monkey.mode == mode
    now = labels_of(monkey)
    assert (now[labels != 1] == labels[labels != 1]).all()
    assert set(now[labels == 1]) == {1, 4, 5}
    assert parts_of(monkey)[:4] == before
    assert [name for name, _, _ in parts_of(monkey)[4:]] == ["Part 05", "Part 06"]
    check_in_step(monkey)


def test_numbers_and_colors_that_became_free_are_used_again(monkey):
    colors = [material.diffuse_color[:] for material in monkey.data.materials]
    bpy.ops.wcd.merge_parts()  # the third goes
    bpy.ops.wcd.split_parts(parts=2)
    assert [number for _, number, _ in parts_of(monkey)] == [0, 1, 2, 3]
    assert [material.diffuse_color[:] for material in monkey.data.materials] == colors
    check_in_step(monkey)


def test_selected_faces_go_to_the_highlighted_part(monkey):
    labels = labels_of(monkey)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    chosen = labels >= 2
    chosen[::3] = False
    select_faces(monkey, chosen, extend=False)
    in_mode(monkey, "EDIT")
    assert bpy.ops.wcd.assign_faces() == {"FINISHED"}
    assert monkey.mode == "EDIT"
    assert (labels_of(monkey) == np.where(chosen, 1, labels)).all()
    check_in_step(monkey)


def test_a_part_all_of_whose_faces_are_given_away_is_gone(monkey):
    in_mode(monkey, "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.wcd.assign_faces()
    assert [name for name, _, _ in parts_of(monkey)] == ["Part 02"]
    check_in_step(monkey)


@pytest.mark.parametrize("direction", ["TO_NEGATIVE", "TO_POSITIVE"])
def test_mirrored_parts_are_symmetric_and_named_for_their_sides(monkey, direction):
    assert bpy.ops.wcd.mirror_parts(direction=direction) == {"FINISHED"}
    names = [name for name, _, _ in parts_of(monkey)]
    sided = {name[:-2] for name in names if name.endswith((".L", ".R"))}
    assert sided
    assert all({f"{name}.L", f"{name}.R"} <= set(names) for name in sided)
    centers = np.array([polygon.center for polygon in monkey.data.polygons])
    other = np.linalg.norm(
        centers[:, None] * [-1, 1, 1] - centers[None], axis=2
    ).argmin(axis=1)
    labels = np.array(names)[labels_of(monkey)]
    flipped = np.array([bpy.utils.flip_name(name) for name in labels])
    off = np.abs(centers[:, 0]) > 1e-4
    assert (labels[other] == flipped)[off].all()
    left = [name.endswith(".L") for name in labels]
    assert centers[left][:, 0].min() > 0
    check_in_step(monkey)
    again = parts_of(monkey)
    bpy.ops.wcd.mirror_parts(direction=direction)
    assert parts_of(monkey) == again


def ragged_grid(n=24):
    """Return a box of n × n quads above with a ragged seam along x = 0."""
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.active_object
    in_mode(obj, "EDIT")
    bpy.ops.mesh.subdivide(number_cuts=n)
    in_mode(obj, "OBJECT")
    rng = np.random.default_rng(0)
    x = np.array([polygon.center.x for polygon in obj.data.polygons])
    labels = (x + rng.uniform(-0.1, 0.1, len(x)) > 0).astype(int)
    labels += 2 * (x < -0.7)
    return obj, labels


def seam_length(obj, labels, chosen):
    """Return the number of edges between two parts."""
    sides = {}
    for polygon, label in zip(obj.data.polygons, labels, strict=True):
        for key in polygon.edge_keys:
            sides.setdefault(key, set()).add(int(label))
    return sum(found == chosen for found in sides.values())


def test_smoothed_seams_are_shorter_and_others_stay():
    obj, labels = ragged_grid()
    write_parts(obj, decomposition_of(labels), Parameters(**FAST))
    obj.wcd_active_part = 1
    assert bpy.ops.wcd.smooth_seams(scope="CHOSEN") == {"FINISHED"}
    smoothed = labels_of(obj)
    assert seam_length(obj, smoothed, {0, 1}) < 0.6 * seam_length(obj, labels, {0, 1})
    assert ((smoothed == 2) == (labels == 2)).all()
    assert (smoothed != labels).mean() < 0.1
    check_in_step(obj)


def test_smoothing_by_nothing_changes_nothing(monkey):
    labels = labels_of(monkey)
    bpy.ops.wcd.smooth_seams(scope="ALL", smoothness=0.0)
    assert (labels_of(monkey) == labels).all()


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


def test_without_locks_names_and_colors_begin_anew(monkey):
    monkey.wcd_parts[0].name = "Left"
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
    with say(poll, match="hidden in Edit Mode"):
        bpy.ops.wcd.isolate_parts()
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
    with say(poll, match="but 3 parts are locked and count too; raise it to 4"):
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
