"""The materials of hulls, and what the list of hulls shows of them."""

import bpy
import pytest
from edited import FAST, record_of
from hand_made import decompose_by_hand
from stand_ins.layout import drawn
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of
from weak_convex_decomposition.ui.hulls_panel import WCD_PT_hulls


def build():
    bpy.context.scene.wcd.samples = 100
    bpy.ops.wcd.build_hulls(max_hulls=4, max_error=0.2)


def test_without_parts_each_hull_has_a_color_of_its_own(suzanne):
    build()
    hulls = hulls_of(suzanne)
    assert len({hull.data.materials[0].name for hull in hulls}) == len(hulls) > 1
    record = record_of(suzanne)["hulls"]
    assert [entry["part"] for entry in record["hulls"]] == [None] * len(hulls)
    assert "parts" not in record_of(suzanne)


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


def test_a_material_before_that_of_the_part_stays(suzanne):
    decompose_by_hand(suzanne, 3)
    bpy.ops.wcd.build_hulls(pieces="PARTS")
    part = suzanne.wcd_parts[0]
    (hull,) = (h for h in hulls_of(suzanne) if h.data.materials[0].name == part.name)
    mine = bpy.data.materials.new("Mine")
    hull.data.materials.append(hull.data.materials[0])
    hull.data.materials[0] = mine
    part.name = "Head"
    assert [material.name for material in hull.data.materials] == ["Mine", "Head"]
    part.color = (0.1, 0.2, 0.3)
    colored = hull.data.materials[1]
    assert tuple(colored.diffuse_color)[:3] == pytest.approx((0.1, 0.2, 0.3))
    assert hull.color[:3] == pytest.approx((0.1, 0.2, 0.3))
    assert "Part 01" not in bpy.data.materials


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


def swatches():
    """Return whose colors the list of hulls shows, and whether it edits any."""
    shown = [
        (owner, enabled)
        for owner, name, enabled in drawn(WCD_PT_hulls).properties()
        if name == "diffuse_color"
    ]
    return [owner for owner, _ in shown], any(enabled for _, enabled in shown)


@pytest.mark.parametrize("look", ["TRANSPARENT", "SOLID"])
def test_the_list_shows_the_colors_that_hulls_are_seen_in_and_edits_none(suzanne, look):
    decompose_by_hand(suzanne, 3, **FAST)
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX", look=look)
    first = hulls_of(suzanne)[0]
    first.material_slots[0].material = mine = bpy.data.materials.new("Mine")
    seen = [hull.material_slots[0].material for hull in hulls_of(suzanne)]
    assert swatches() == (seen, False)
    assert mine in seen


def test_the_list_finds_linked_hulls_beside_objects_of_their_names(suzanne, tmp_path):
    build()
    hulls, path = hulls_of(suzanne), str(tmp_path / "hulls.blend")
    names = [hull.name for hull in hulls]
    bpy.data.libraries.write(path, {suzanne, *hulls})
    for obj in (suzanne, *hulls):
        bpy.data.objects.remove(obj)
    for name in names:
        assert bpy.data.objects.new(name, None).name == name
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = ["Suzanne", *names]
    linked = bpy.data.objects["Suzanne"]
    bpy.context.collection.objects.link(linked)
    bpy.context.view_layer.objects.active = linked
    seen, _ = swatches()
    assert seen == [hull.material_slots[0].material for hull in hulls_of(linked)]


def test_hulls_of_parts_that_the_object_does_not_have_belong_to_none(suzanne):
    bpy.context.scene.wcd.samples, bpy.context.scene.wcd.parts = 100, 3
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX")
    hulls = record_of(suzanne)["hulls"]["hulls"]
    assert [hull["part"] for hull in hulls] == [None] * 3
    assert len(suzanne.wcd_parts) == 0
