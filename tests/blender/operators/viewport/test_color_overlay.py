"""Colors of parts as an overlay: slots and materials stay as the user had them."""

import bpy
import numpy as np
import pytest
from edited import check_in_step, record_of
from hand_made import activate, decompose_by_hand, give_user_data, in_mode
from snapshot import snapshot
from stand_ins.presses import Pressed
from weak_convex_decomposition.operators.bridge.parts.materials import name_of
from weak_convex_decomposition.operators.bridge.parts.part_materials import is_overlaid
from weak_convex_decomposition.operators.bridge.parts.read import (
    noted_identities,
    part_identities,
)
from weak_convex_decomposition.operators.use_parts import WCD_OT_show_colors

FAST = {"samples": 100, "parts": 3}


@pytest.fixture
def owned(suzanne):
    """Suzanne with groups, slots and materials of the user's."""
    give_user_data(suzanne)
    return suzanne


def show(choice):
    assert bpy.ops.wcd.show_colors(colors=choice) == {"FINISHED"}


def looks(obj):
    """Return the slots of an object, and the material index of each face."""
    slots = [(s.link, s.material and s.material.name) for s in obj.material_slots]
    return slots, [p.material_index for p in obj.data.polygons]


def test_later_runs_do_what_a_button_shows_also_once_it_is_adjusted(suzanne):
    decompose_by_hand(suzanne, 3)
    settings = bpy.context.scene.wcd
    show("OVERLAY")  # as scripts do
    assert settings.colors == "MATERIALS"
    pressed = Pressed(WCD_OT_show_colors)
    pressed.colors = "OVERLAY"
    assert pressed.invoke(bpy.context, None) == {"FINISHED"}
    assert settings.colors == "OVERLAY"
    settings.colors = "MATERIALS"  # Adjust Last Operation begins with undo
    assert pressed.execute(bpy.context) == {"FINISHED"}
    assert settings.colors == "OVERLAY"


def test_decompose_leaves_slots_alone_as_an_overlay(owned):
    before, plain = snapshot(owned), looks(owned)
    bpy.ops.wcd.decompose(**FAST, colors="OVERLAY")
    assert looks(owned) == plain
    assert is_overlaid(owned)
    assert len(part_identities(owned)) == 3
    bpy.ops.wcd.merge_parts.poll()
    bpy.ops.wcd.choose_part_count(parts=4)  # runs keep the overlay
    assert looks(owned) == plain
    assert len(part_identities(owned)) == 4
    bpy.ops.wcd.clear()
    assert snapshot(owned) == before


def test_scripts_get_materials_unless_they_ask(owned):
    bpy.ops.wcd.decompose(**FAST)
    assert [s.material.name for s in owned.material_slots[3:]] == [
        each.name for each in part_identities(owned)
    ]


def test_switching_there_and_back_restores_exactly(owned):
    plain = looks(owned)
    decompose_by_hand(owned, 4)
    head = owned.material_slots[4].material
    head.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.125
    before = snapshot(owned)
    show("OVERLAY")
    assert looks(owned) == plain
    show("OVERLAY")
    assert looks(owned) == plain
    show("MATERIALS")
    assert snapshot(owned) == before
    assert owned.material_slots[4].material == head
    show("MATERIALS")
    assert snapshot(owned) == before


def test_materials_come_after_what_the_user_has_now(suzanne):
    decompose_by_hand(suzanne, 2)
    show("OVERLAY")
    suzanne.data.materials.append(bpy.data.materials.new("Gold"))
    suzanne.data.materials.append(bpy.data.materials.new("Skin"))
    for polygon in suzanne.data.polygons:
        polygon.material_index = polygon.index % 2
    plain = looks(suzanne)
    show("MATERIALS")
    names = [slot.material.name for slot in suzanne.material_slots]
    assert names == ["Gold", "Skin", "Part 01", "Part 02"]
    bpy.ops.wcd.clear()
    assert looks(suzanne) == plain


def test_names_and_colors_are_kept_and_reach_hulls(suzanne):
    bpy.ops.wcd.decompose(**FAST, colors="OVERLAY")
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX")
    suzanne.wcd_parts[1].name = "Ear"
    suzanne.wcd_parts[1].color = (0.25, 0.5, 0.75)
    assert noted_identities(suzanne)[suzanne.wcd_parts[1].number].name == "Ear"
    assert suzanne.wcd_parts[1].color[:] == (0.25, 0.5, 0.75)
    ears = [h.data.materials[0] for h in suzanne.children if h.name.endswith("02")]
    assert [name_of(ear) for ear in ears] == ["Ear"]
    assert ears[0].diffuse_color[:3] == (0.25, 0.5, 0.75)
    show("MATERIALS")
    ear = suzanne.material_slots[1].material
    assert name_of(ear) == "Ear"
    assert ear.diffuse_color[:3] == (0.25, 0.5, 0.75)


def test_an_overlay_is_saved_and_is_one_undo_step(suzanne, tmp_path):
    decompose_by_hand(suzanne, 3)
    bpy.ops.ed.undo_push(message="before")
    before = snapshot(suzanne)
    bpy.ops.wcd.show_colors("EXEC_DEFAULT", True, colors="OVERLAY")
    bpy.ops.ed.undo()
    assert snapshot(bpy.context.active_object) == before
    show("OVERLAY")
    path = str(tmp_path / "overlay.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    suzanne = bpy.context.active_object
    assert is_overlaid(suzanne)
    show("MATERIALS")
    assert snapshot(suzanne) == before


def test_edit_mode_could_not_take_it_back(suzanne):
    decompose_by_hand(suzanne, 2)
    in_mode(suzanne, "EDIT")
    with pytest.raises(RuntimeError, match="switch to Object Mode"):
        show("OVERLAY")
    assert not is_overlaid(suzanne)


@pytest.mark.parametrize(
    "kinds",
    [("OVERLAY", "OVERLAY"), ("OVERLAY", "MATERIALS"), ("MATERIALS", "OVERLAY")],
)
def test_joined_objects_keep_their_parts_apart(suzanne, kinds):
    decompose_by_hand(suzanne, 3)
    show(kinds[0])
    bpy.ops.mesh.primitive_cube_add(location=(4, 0, 0))
    cube = bpy.context.active_object
    decompose_by_hand(cube, 2)
    show(kinds[1])
    activate(suzanne)
    cube.select_set(True)
    bpy.ops.object.join()
    assert len(part_identities(suzanne)) == 5
    bpy.ops.wcd.refresh_parts()
    record = record_of(suzanne)
    assert sorted(part["faces"] for part in record["parts"]) == [3, 3, 166, 167, 167]
    assert is_overlaid(suzanne) == (kinds[0] == "OVERLAY")
    bpy.ops.wcd.clear()
    assert not [a.name for a in suzanne.data.attributes if a.name.startswith("wcd")]
    assert not suzanne.data.keys()
    assert not [m for m in suzanne.data.materials if m]


def test_copies_have_overlays_of_their_own(suzanne):
    decompose_by_hand(suzanne, 3)
    show("OVERLAY")
    bpy.ops.object.duplicate()
    copy = bpy.context.active_object
    show("MATERIALS")
    assert is_overlaid(suzanne)
    mine = set(copy.data.materials)
    assert not mine & set(suzanne.data["wcd_overlay"].values())
    show("OVERLAY")
    suzanne.select_set(True)
    bpy.context.view_layer.objects.active = suzanne
    bpy.ops.object.join()
    assert len(part_identities(suzanne)) == 6
    assert np.ptp([each.number for each in part_identities(suzanne)]) >= 5


@pytest.mark.parametrize("refreshed", [False, True])
@pytest.mark.parametrize("joined", ["OVERLAY", "MATERIALS"])
@pytest.mark.parametrize("own", [None, "OVERLAY", "MATERIALS"])
def test_groups_of_joined_parts_go_with_clear(suzanne, refreshed, own, joined):
    suzanne.vertex_groups.new(name="mine")
    if own:
        decompose_by_hand(suzanne, 2)
        show(own)
    bpy.ops.mesh.primitive_cube_add(location=(4, 0, 0))
    cube = bpy.context.active_object
    decompose_by_hand(cube, 3)
    show(joined)
    cube.wcd_parts[2].name = "Head"
    activate(suzanne)
    cube.select_set(True)
    bpy.ops.object.join()
    assert "Head" in suzanne.vertex_groups
    if refreshed:
        bpy.ops.wcd.refresh_parts()
    bpy.ops.wcd.clear()
    assert [group.name for group in suzanne.vertex_groups] == ["mine"]
    assert not [a.name for a in suzanne.data.attributes if a.name.startswith("wcd")]


def test_a_separated_part_keeps_its_material_as_the_users(suzanne):
    decompose_by_hand(suzanne, 3)
    bpy.ops.wcd.separate()
    piece = next(o for o in bpy.data.objects if o.name.endswith("Part 02"))
    activate(piece)
    plain = looks(piece)
    decompose_by_hand(piece, 3)
    check_in_step(piece)
    show("OVERLAY")
    assert looks(piece) == plain
    check_in_step(piece)
    show("MATERIALS")
    check_in_step(piece)
    bpy.ops.wcd.clear()
    assert looks(piece) == plain
