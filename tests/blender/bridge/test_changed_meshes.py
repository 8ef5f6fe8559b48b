"""Meshes that change outside of our operators: figures follow, Clear leaves nothing."""

import bmesh
import bpy
import numpy as np
import pytest
from edited import FAST, check_in_step, record_of
from hand_made import activate, decompose_by_hand, give_user_data, in_mode
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.parts.figures import figures_of
from weak_convex_decomposition.operators.bridge.parts.materials import is_ours
from weak_convex_decomposition.ui.chart import WCD_PT_chart


def state(obj):
    """Return what the table says: names, faces, ranks, number of parts and psi."""
    figures = figures_of(obj)
    faces = figures.measured_on[:, 0].tolist()
    names = [each.name for each in figures.identities]
    ranks = np.round(figures.ranks, 6).tolist()
    record = figures.record
    return names, faces, ranks, figures.problem, record["k"], record["psi"]


def names_of(obj):
    return [each.name for each in figures_of(obj).identities]


def check_cleared(obj):
    """Clear an object, and check that nothing of ours is left on it."""
    activate(obj)
    bpy.ops.wcd.clear()
    assert not [a for a in obj.data.attributes if a.name.startswith("wcd")]
    assert not any(map(is_ours, obj.data.materials))
    assert not [group for group in obj.vertex_groups if group.name != "mine"]
    assert "wcd" not in obj
    assert "wcd_restore" not in obj.data
    assert not obj.wcd_parts


EDITS = {
    "merge_parts": {},
    "split_parts": {"parts": 2},
    "assign_faces": {},
    "smooth_seams": {"scope": "ALL", "smoothness": 20.0},
    "mirror_parts": {},
}


@pytest.mark.parametrize("name", EDITS)
def test_undo_in_edit_mode_brings_all_back(monkey, name):
    in_mode(monkey, "EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bmesh.from_edit_mesh(monkey.data).faces.ensure_lookup_table()
    for face in bmesh.from_edit_mesh(monkey.data).faces[:40]:
        face.select_set(True)
    bpy.ops.ed.undo_push(message="Select")
    states = [state(monkey)]
    getattr(bpy.ops.wcd, name)("EXEC_DEFAULT", True, **EDITS[name])
    states.append(state(monkey))
    assert states[0] != states[1]
    assert states[0][3] is states[1][3] is None
    bpy.ops.mesh.flip_normals("EXEC_DEFAULT", True)  # a step of the mesh alone
    bpy.ops.wcd.split_parts("EXEC_DEFAULT", True, parts=3)
    states.append(state(bpy.context.active_object))
    undo, redo = bpy.ops.ed.undo, bpy.ops.ed.redo
    for step, expected in (
        *((undo, 1), (undo, 1), (undo, 0)),
        *((redo, 1), (redo, 1), (redo, 2), (undo, 1), (undo, 1), (undo, 0)),
    ):
        step()
        monkey = bpy.context.active_object
        assert monkey.mode == "EDIT"
        assert state(monkey) == states[expected]
    in_mode(monkey, "OBJECT")
    assert state(monkey) == states[0]
    check_in_step(monkey)
    check_cleared(monkey)


def two_objects():
    """Return two objects with parts, of which both have a part 1 and one a Head."""
    bpy.ops.mesh.primitive_torus_add(major_segments=12, minor_segments=6)
    torus = bpy.context.active_object
    decompose_by_hand(torus, 2, **FAST)
    torus.wcd_parts[1].name = "Ring"
    bpy.ops.mesh.primitive_monkey_add(location=(4, 0, 0))
    suzanne = bpy.context.active_object
    decompose_by_hand(suzanne, 3, **FAST)
    suzanne.wcd_parts[0].name = "Head"
    return suzanne, torus


def test_a_join_keeps_the_parts_of_both_apart():
    suzanne, torus = two_objects()
    counts = [167, 167, 166, 36, 36]
    torus.select_set(True)
    bpy.ops.object.join()
    names, faces, _, problem, *_ = state(suzanne)
    assert names == ["Head", "Part 02", "Part 03", "Part 01", "Ring"]
    assert faces == counts
    assert "after a join" in problem
    bpy.ops.wcd.refresh_parts()
    assert state(suzanne)[:2] == (names, faces)
    assert state(suzanne)[3] is None
    check_in_step(suzanne)


@pytest.mark.parametrize("refreshed", [False, True])
def test_clear_after_a_join_takes_the_groups_of_both(refreshed):
    suzanne, torus = two_objects()
    suzanne.vertex_groups.new(name="mine")
    torus.select_set(True)
    bpy.ops.object.join()
    if refreshed:
        bpy.ops.wcd.refresh_parts()
    check_cleared(suzanne)
    assert [group.name for group in suzanne.vertex_groups] == ["mine"]


def test_names_after_a_join_ask_for_a_refresh():
    one, other = two_objects()
    other.select_set(True)
    bpy.ops.object.join()
    with pytest.raises(RuntimeError, match="not listed, as after a join or an applied"):
        bpy.ops.wcd.rename_parts(way="NUMBER", pattern="Limb ##")
    bpy.ops.wcd.refresh_parts()
    bpy.ops.wcd.rename_parts(way="NUMBER", pattern="Limb ##")
    assert {name[:4] for name in names_of(one)} == {"Limb"}


def test_a_join_of_copies_keeps_their_parts_apart(monkey):
    monkey.wcd_parts[0].name = "Head"
    bpy.ops.object.duplicate()
    bpy.context.active_object.location.x = 5
    copy = bpy.context.active_object
    monkey.select_set(True)
    bpy.ops.object.join()
    names = names_of(copy)
    assert len(names) == 8
    assert {"Head", "Head.001"} < set(names)
    bpy.ops.wcd.refresh_parts()
    check_in_step(copy)
    check_cleared(copy)


def test_loose_pieces_have_the_parts_that_are_on_them(monkey):
    bpy.ops.mesh.separate(type="LOOSE")
    pieces = list(bpy.context.selected_objects)
    assert len(pieces) == 3
    for piece in pieces:
        activate(piece)
        assert sum(state(piece)[1]) == len(piece.data.polygons)
        assert "changed" in state(piece)[3]
        bpy.ops.wcd.refresh_parts()
        assert state(piece)[3] is None
        check_in_step(piece)
    for piece in pieces:
        check_cleared(piece)
    assert not bpy.data.materials


@pytest.mark.parametrize("kind", ["SUBSURF", "MIRROR", "ARRAY", "TRIANGULATE"])
def test_figures_follow_an_applied_modifier(monkey, kind):
    modifier = monkey.modifiers.new("Any", kind)
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    names, faces, _, problem, *_ = state(monkey)
    assert sum(faces) == len(monkey.data.polygons)
    assert len(names) == (8 if kind == "ARRAY" else 4)
    assert problem
    bpy.ops.wcd.refresh_parts()
    assert state(monkey)[:2] == (names, faces)
    check_in_step(monkey)
    check_cleared(monkey)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_figures_follow_deleted_faces(monkey, mode):
    for polygon in monkey.data.polygons:
        polygon.select = polygon.center.x > -0.1
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    in_mode(monkey, "EDIT")
    bpy.ops.mesh.delete(type="FACE")
    in_mode(monkey, mode)
    names, faces, ranks, problem, *_ = state(monkey)
    assert names == ["Part 01", "Part 02", "Part 03"][: len(names)]
    assert faces[0] == 125
    assert np.isfinite(ranks[0])  # not a face of it is gone
    assert np.isnan(ranks[-1])
    assert "changed" in problem
    assert record_of(monkey)["psi_by_k"]
    bpy.ops.wcd.refresh_parts()
    assert not record_of(monkey)["psi_by_k"]  # these were the whole monkey's
    assert WCD_PT_chart.poll(bpy.context) is False


def test_linked_duplicates_have_one_result(suzanne):
    give_user_data(suzanne)
    before = snapshot(suzanne)
    twin = suzanne.copy()
    bpy.context.collection.objects.link(twin)
    decompose_by_hand(suzanne, 3, **FAST)
    assert state(twin) == state(suzanne)
    check_in_step(twin)
    twin.wcd_parts[0].name = "Named"
    assert suzanne.wcd_parts[0].name == "Named"
    check_in_step(suzanne)
    activate(twin)
    bpy.ops.wcd.clear()
    bpy.data.objects.remove(twin)
    bpy.context.view_layer.update()
    activate(suzanne)
    assert snapshot(suzanne) == before


def test_an_object_appended_twice_keeps_its_colors(monkey, tmp_path):
    monkey.wcd_parts[0].color = (0.25, 0.5, 0.75)
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    for _ in range(2):
        with bpy.data.libraries.load(path) as (_, chosen):
            chosen.objects = ["Suzanne"]
        (obj,) = chosen.objects
        bpy.context.collection.objects.link(obj)
        check_in_step(obj)
        assert tuple(obj.wcd_parts[0].color) == (0.25, 0.5, 0.75)
        obj.wcd_parts[0].color = (0.75, 0.5, 0.25)
    assert tuple(monkey.wcd_parts[0].color) == (0.25, 0.5, 0.75)
