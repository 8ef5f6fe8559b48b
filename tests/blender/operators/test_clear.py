import bpy
import pytest
from edited import record_of
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
from weak_convex_decomposition.operators.bridge.parts import erase, write

MODES = pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])


@MODES
@pytest.mark.parametrize("user_data", [False, True])
def test_clear_brings_everything_back(suzanne, user_data, mode):
    if user_data:
        give_user_data(suzanne)
    in_mode(suzanne, "EDIT")  # Edit Mode itself adds and drops layers
    in_mode(suzanne, "OBJECT")
    before = snapshot(suzanne)
    in_mode(suzanne, mode)
    decompose_by_hand(suzanne, 5)
    decompose_by_hand(suzanne, 4)
    erase.clear(suzanne)
    assert suzanne.mode == mode
    in_mode(suzanne, "OBJECT")
    assert snapshot(suzanne) == before


@pytest.mark.parametrize("there", ["OBJECT", "EDIT"])
def test_clear_works_in_the_other_mode(suzanne, there):
    give_user_data(suzanne)
    in_mode(suzanne, "EDIT")
    in_mode(suzanne, "OBJECT")
    before = snapshot(suzanne)
    in_mode(suzanne, there)
    decompose_by_hand(suzanne, 5)
    in_mode(suzanne, "OBJECT" if there == "EDIT" else "EDIT")
    erase.clear(suzanne)
    in_mode(suzanne, "OBJECT")
    assert snapshot(suzanne) == before


def test_material_indices_that_were_there_stay_there():
    cube = mesh_object(
        "strip",
        [(x, y, 0) for x in range(4) for y in (0, 1)],
        [(0, 1, 3, 2), (2, 3, 5, 4)],
    )
    for values in ([0, 0], [1, 1], [0, 2]):
        cube.data.polygons.foreach_set("material_index", values)
        before = snapshot(cube)
        assert "material_index" in before["mesh"]["attributes"]
        write.write_parts(cube, decomposition_of([0, 1]), Parameters())
        erase.clear(cube)
        assert snapshot(cube) == before


def test_renamed_groups_and_materials_are_the_users(suzanne):
    decompose_by_hand(suzanne, 3)
    suzanne.vertex_groups["Part 02"].name = "head"
    bpy.data.materials["Part 03"].name = "Hair"
    erase.clear(suzanne)
    assert [group.name for group in suzanne.vertex_groups] == ["head"]
    # The other faces had no material.
    assert [slot.name for slot in suzanne.material_slots] == ["", "Hair"]
    n_hairy = sum(polygon.material_index for polygon in suzanne.data.polygons)
    assert n_hairy == 166
    assert [material.name for material in bpy.data.materials] == ["Hair"]


def test_faces_given_other_materials_keep_them(suzanne):
    give_user_data(suzanne)
    before = [polygon.material_index for polygon in suzanne.data.polygons]
    decompose_by_hand(suzanne, 3)
    late = bpy.data.materials.new("Late")
    suzanne.data.materials.append(late)
    suzanne.material_slots[6].link = "OBJECT"
    suzanne.material_slots[6].material = late
    for index in range(10):
        suzanne.data.polygons[index].material_index = 6
    erase.clear(suzanne)
    after = [polygon.material_index for polygon in suzanne.data.polygons]
    assert after == [3] * 10 + before[10:]
    links = [(slot.link, slot.name) for slot in suzanne.material_slots]
    assert links == [
        ("DATA", "Gold"),
        ("OBJECT", "Own"),
        ("DATA", ""),
        ("OBJECT", "Late"),
    ]


def test_a_slot_removed_meanwhile_does_not_shift_the_others(suzanne):
    for name in ("Gold", "Skin", "Hair"):
        suzanne.data.materials.append(bpy.data.materials.new(name))
    for polygon in suzanne.data.polygons:
        polygon.material_index = polygon.index % 3
    decompose_by_hand(suzanne, 3)
    suzanne.data.materials.pop(index=1)
    erase.clear(suzanne)
    assert [slot.name for slot in suzanne.material_slots] == ["Gold", "Hair"]
    for polygon in suzanne.data.polygons:
        assert polygon.material_index == (0, 0, 1)[polygon.index % 3]


def test_clear_after_the_topology_changed(suzanne):
    give_user_data(suzanne)
    decompose_by_hand(suzanne, 3)
    in_mode(suzanne, "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    in_mode(suzanne, "OBJECT")
    erase.clear(suzanne)
    assert [group.name for group in suzanne.vertex_groups] == ["Part 01", "spine"]
    assert {polygon.material_index for polygon in suzanne.data.polygons} == {0, 1, 2}
    assert "wcd_part" not in suzanne.data.attributes


def test_survives_saving_and_loading(suzanne, tmp_path):
    give_user_data(suzanne)
    path = str(tmp_path / "before.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.context.active_object
    before = snapshot(obj)
    labels = decompose_by_hand(obj, 4)
    path = str(tmp_path / "parts.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.context.active_object
    assert (face_values(obj.data, "wcd_part") == labels).all()
    assert record_of(obj)["k"] == 4
    erase.clear(obj)
    assert snapshot(obj) == before


def test_clear_takes_materials_whose_slots_the_user_removed(suzanne):
    before = snapshot(suzanne)
    decompose_by_hand(suzanne, 3)
    suzanne.data.materials.pop(index=1)
    erase.clear(suzanne)
    assert snapshot(suzanne) == before


def test_a_material_deleted_meanwhile_leaves_no_slot_behind(suzanne):
    gold, skin = (bpy.data.materials.new(name) for name in ("Gold", "Skin"))
    for material in (gold, skin):
        suzanne.data.materials.append(material)
    for polygon in suzanne.data.polygons:
        polygon.material_index = polygon.index % 2
    before = snapshot(suzanne)
    for _ in range(2):
        decompose_by_hand(suzanne, 3)
        bpy.data.materials.remove(bpy.data.materials["Part 01"])
    bpy.ops.wcd.clear()
    assert snapshot(suzanne) == before


def test_the_users_group_is_active_again_where_one_of_a_part_was(suzanne):
    for name in ("hips", "spine"):
        suzanne.vertex_groups.new(name=name)
    suzanne.vertex_groups.active_index = 0
    decompose_by_hand(suzanne, 3)
    suzanne.vertex_groups.active_index = 3
    erase.clear(suzanne)
    assert suzanne.vertex_groups.active.name == "hips"


def test_an_empty_slot_that_was_added_to_an_overlay_stays(suzanne):
    decompose_by_hand(suzanne, 3)
    bpy.ops.wcd.show_colors(colors="OVERLAY")
    suzanne.data.materials.append(bpy.data.materials.new("Gold"))
    suzanne.data.materials.append(None)
    suzanne.data.polygons[0].material_index = 1
    erase.clear(suzanne)
    assert suzanne.data.materials[:] == [bpy.data.materials["Gold"], None]
    assert suzanne.data.polygons[0].material_index == 1


def test_an_object_that_shares_the_mesh_keeps_materials_of_its_own(suzanne):
    other = bpy.data.objects.new("Other", suzanne.data)
    bpy.context.collection.objects.link(other)
    decompose_by_hand(suzanne, 3)
    suzanne.data.materials.append(bpy.data.materials.new("Late"))
    other.material_slots[3].link = "OBJECT"
    other.material_slots[3].material = bpy.data.materials.new("Own")
    erase.clear(suzanne)
    assert [(slot.link, slot.name) for slot in other.material_slots] == [
        ("OBJECT", "Own")
    ]


def test_a_slot_that_was_added_and_chosen_since_stays_the_chosen_one(suzanne):
    decompose_by_hand(suzanne, 3)
    for name in ("Late", "Later"):
        suzanne.data.materials.append(bpy.data.materials.new(name))
    suzanne.active_material_index = 3
    erase.clear(suzanne)
    assert suzanne.active_material.name == "Late"


@MODES
def test_clear_takes_the_color_attribute(suzanne, mode):
    decompose_by_hand(suzanne, 3)
    bpy.ops.wcd.color_attribute()
    assert "wcd_color" in suzanne.data.attributes
    in_mode(suzanne, mode)
    erase.clear(suzanne)
    in_mode(suzanne, "OBJECT")
    assert "wcd_color" not in suzanne.data.attributes
