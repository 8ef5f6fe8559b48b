"""The materials of hulls that are of no part."""

import json

import bpy
import pytest
from hand_made import decompose_by_hand
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of


def build():
    bpy.context.scene.wcd.samples = 100
    bpy.ops.wcd.build_hulls(max_hulls=4, max_error=0.2)


def test_without_parts_each_hull_has_a_color_of_its_own(suzanne):
    build()
    hulls = hulls_of(suzanne)
    assert len({hull.data.materials[0].name for hull in hulls}) == len(hulls) > 1
    record = json.loads(suzanne["wcd"])["hulls"]
    assert [entry["part"] for entry in record["hulls"]] == [None] * len(hulls)
    assert "parts" not in json.loads(suzanne["wcd"])


def test_hulls_of_no_part_share_materials_with_those_of_other_objects(suzanne):
    users = bpy.data.materials.new("Hull 01")
    build()
    worn = [hull.data.materials[0] for hull in hulls_of(suzanne)]
    assert worn[0].name == "Hull 01.001"
    assert worn[1].name == "Hull 02"
    worn[1].diffuse_color = (0.1, 0.2, 0.3, 1.0)
    copy = suzanne.copy()
    copy.data = suzanne.data.copy()
    bpy.context.collection.objects.link(copy)
    bpy.context.view_layer.objects.active = copy
    suzanne.select_set(False)
    build()
    hulls = hulls_of(copy)
    assert [hull.data.materials[0] for hull in hulls] == worn
    assert hulls[1].color[:3] == pytest.approx((0.1, 0.2, 0.3))
    # They go with the last hull.
    bpy.ops.wcd.remove_hulls()
    assert [hull.data.materials[0] for hull in hulls_of(suzanne)] == worn
    bpy.context.view_layer.objects.active = suzanne
    suzanne.select_set(True)
    bpy.ops.wcd.remove_hulls()
    assert [m for m in bpy.data.materials if m.name.startswith("Hull")] == [users]


def test_hulls_and_parts_share_materials_also_after_an_edit(suzanne):
    decompose_by_hand(suzanne, 3)
    bpy.ops.wcd.build_hulls(pieces="PARTS")
    suzanne.wcd_parts[0].chosen = True
    bpy.ops.wcd.smooth_seams()
    names = [slot.name for slot in suzanne.material_slots]
    assert names == ["Part 01", "Part 02", "Part 03"]
    suzanne.wcd_parts[1].color = (0.1, 0.2, 0.3)
    colors = [
        tuple(hull.data.materials[0].diffuse_color[:3]) for hull in hulls_of(suzanne)
    ]
    assert pytest.approx((0.1, 0.2, 0.3)) in colors


def test_a_mesh_that_hulls_were_joined_to_has_no_parts_of_theirs(suzanne):
    build()
    with bpy.context.temp_override(selected_editable_objects=bpy.data.objects[:]):
        bpy.ops.object.join()
    slots = [slot.name for slot in suzanne.material_slots]
    assert any(slot.startswith("Hull 01") for slot in slots)
    decompose_by_hand(suzanne, 3)
    parts = ["Part 01", "Part 02", "Part 03"]
    assert [slot.name for slot in suzanne.material_slots] == slots + parts
    bpy.ops.wcd.clear()
    assert [slot.name for slot in suzanne.material_slots] == slots
