import bpy
import numpy as np
import pytest
from edited import record_of
from hand_made import (
    activate,
    decompose_by_hand,
    decomposition_of,
    face_values,
    give_user_data,
    in_mode,
)
from snapshot import snapshot
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.operators.bridge.parts import erase, write
from weak_convex_decomposition.operators.bridge.parts.read import part_labels

MODES = pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])


@MODES
def test_every_part_gets_its_group_slot_and_faces(suzanne, mode):
    in_mode(suzanne, mode)
    labels = decompose_by_hand(suzanne, 4)
    assert suzanne.mode == mode
    in_mode(suzanne, "OBJECT")
    names = ["Part 01", "Part 02", "Part 03", "Part 04"]
    assert [group.name for group in suzanne.vertex_groups] == names
    assert [slot.name for slot in suzanne.material_slots] == names
    mesh = suzanne.data
    assert mesh.attributes["wcd_part"].domain == "FACE"
    assert (face_values(mesh, "wcd_part") == labels).all()
    assert [p.material_index for p in mesh.polygons] == labels.tolist()
    belongs = {(p, v) for f, p in enumerate(labels) for v in mesh.polygons[f].vertices}
    weights = {(g.group, v.index) for v in mesh.vertices for g in v.groups}
    assert weights == belongs
    assert {g.weight for v in mesh.vertices for g in v.groups} == {1.0}


def test_the_record_tells_what_was_done(suzanne):
    labels = decompose_by_hand(suzanne, 3, alpha=0.4, seed=7)
    record = record_of(suzanne)
    assert record["parameters"]["alpha"] == 0.4
    assert record["seed"] == 7
    assert record["k"] == 3
    assert record["psi"] == 0.75
    assert record["psi_before"] == 0.5
    assert record["psi_by_k"] == {"1": 0.5, "2": 0.6, "3": 0.75}
    assert record["best_k"] == 3
    counts = np.bincount(labels)
    assert [part["faces"] for part in record["parts"]] == counts.tolist()
    assert [part["area"] for part in record["parts"]] == (counts / 2).tolist()
    assert [part["convexity_rank"] for part in record["parts"]] == [1.0, 0.75, 0.5]
    assert [part["name"] for part in record["parts"]] == [
        group.name for group in suzanne.vertex_groups
    ]


def test_the_record_has_the_version_of_the_manifest(suzanne):
    import tomllib

    from conftest import ROOT

    decompose_by_hand(suzanne, 2)
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text())
    assert record_of(suzanne)["version"] == manifest["version"]


def test_materials_show_in_solid_shading_and_in_renders(suzanne):
    decompose_by_hand(suzanne, 3)
    colors = [tuple(slot.material.diffuse_color) for slot in suzanne.material_slots]
    assert len(set(colors)) == 3
    for slot, color in zip(suzanne.material_slots, colors, strict=True):
        nodes = slot.material.node_tree.nodes
        (shader,) = (node for node in nodes if node.type == "BSDF_PRINCIPLED")
        assert tuple(shader.inputs["Base Color"].default_value) == color


@MODES
def test_running_again_replaces_what_was_written(suzanne, mode):
    give_user_data(suzanne)
    in_mode(suzanne, mode)
    decompose_by_hand(suzanne, 6)
    first = {m.name: m.session_uid for m in bpy.data.materials}
    in_mode(suzanne, "OBJECT")
    decompose_by_hand(suzanne, 3)
    after_both = snapshot(suzanne)
    second = {m.name: m.session_uid for m in bpy.data.materials}
    assert len(second) == 6
    assert set(second) > {"Gold", "Skin", "Own"}
    assert all(first[name] == second[name] for name in second)
    in_mode(suzanne, mode)
    decompose_by_hand(suzanne, 3)
    in_mode(suzanne, "OBJECT")
    assert snapshot(suzanne) == after_both


@MODES
def test_what_is_the_users_survives_the_writing(suzanne, mode):
    give_user_data(suzanne)
    before = snapshot(suzanne)
    in_mode(suzanne, mode)
    decompose_by_hand(suzanne, 4)
    in_mode(suzanne, "OBJECT")
    after = snapshot(suzanne)
    for key in ("active_slot", "active_group", "selected", "mode", "modifiers"):
        assert after["object"][key] == before["object"][key]
    assert after["object"]["slots"][:3] == before["object"]["slots"]
    assert after["object"]["groups"][:2] == before["object"]["groups"]
    assert suzanne.vertex_groups[2].name == "Part 01.001"
    weights = [[g for g in v if g[0] < 2] for v in after["mesh"]["weights"]]
    assert weights == before["mesh"]["weights"]
    for key in ("vertices", "edges", "shape_keys"):
        assert after["mesh"][key] == before["mesh"][key]
    assert after["mesh"]["attributes"]["dust"] == before["mesh"]["attributes"]["dust"]


def test_edit_mode_keeps_the_selection(suzanne):
    in_mode(suzanne, "EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.mesh.select_random(ratio=0.3, seed=1)
    suzanne.update_from_editmode()
    selected = [polygon.select for polygon in suzanne.data.polygons]
    assert 0 < sum(selected) < len(selected)
    decompose_by_hand(suzanne, 4)
    suzanne.update_from_editmode()
    assert [polygon.select for polygon in suzanne.data.polygons] == selected


def test_a_mesh_of_several_objects_is_written_once(suzanne):
    give_user_data(suzanne)
    twin = bpy.data.objects.new("twin", suzanne.data)
    bpy.context.collection.objects.link(twin)
    before = snapshot(suzanne)
    decompose_by_hand(suzanne, 4)
    activate(twin)
    decompose_by_hand(twin, 3)
    assert suzanne["wcd"] == twin["wcd"]
    names = [part["name"] for part in record_of(twin)["parts"]]
    for sharer in (suzanne, twin):
        assert [row.name for row in sharer.wcd_parts] == names
        assert [group.name for group in sharer.vertex_groups][2:] == names
    assert len(names) == 3
    assert len(twin.material_slots) == len(suzanne.material_slots) == 6
    activate(suzanne)
    erase.clear(suzanne)
    assert snapshot(suzanne) == before
    assert "wcd" not in twin


def test_objects_that_share_a_mesh_have_locks_of_their_own(suzanne):
    twin = bpy.data.objects.new("twin", suzanne.data)
    bpy.context.collection.objects.link(twin)
    decompose_by_hand(suzanne, 3)
    suzanne.wcd_parts[0].locked = twin.wcd_parts[2].locked = True
    decompose_by_hand(suzanne, 3)
    assert [row.locked for row in suzanne.wcd_parts] == [True, False, False]
    assert [row.locked for row in twin.wcd_parts] == [False, False, True]


def test_each_object_has_materials_of_its_own(suzanne):
    decompose_by_hand(suzanne, 3)
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    decompose_by_hand(cube, 2)
    assert not set(cube.data.materials) & set(suzanne.data.materials)
    before = [material.diffuse_color[:] for material in suzanne.data.materials]
    cube.wcd_parts[1].color = (0.5, 0.25, 0.125)
    assert [m.diffuse_color[:] for m in suzanne.data.materials] == before
    assert cube.data.materials[1].diffuse_color[:] == (0.5, 0.25, 0.125, 1.0)
    erase.clear(suzanne)
    assert set(bpy.data.materials) == set(cube.data.materials)
    erase.clear(cube)
    assert len(bpy.data.materials) == 0


def test_a_users_material_of_the_same_name_is_not_touched(suzanne):
    mine = bpy.data.materials.new("Part 01")
    mine.use_fake_user = True
    decompose_by_hand(suzanne, 2)
    assert mine.users == 1
    assert suzanne.material_slots[0].name == "Part 01.001"
    erase.clear(suzanne)
    assert bpy.data.materials[:] == [mine]


@pytest.mark.parametrize("domain", ["POINT", "FACE"])
def test_a_users_attribute_of_our_name_is_refused(suzanne, domain):
    for name in ("wcd_part", "wcd_material_index"):
        suzanne.data.attributes.new(name, "INT", domain)
        before = snapshot(suzanne)
        with pytest.raises(DecompositionError, match=f"vertex group {name} that"):
            decompose_by_hand(suzanne, 2)
        assert snapshot(suzanne) == before
        suzanne.data.attributes.remove(suzanne.data.attributes[name])


OTHER_TYPES = [("INT", "POINT"), ("FLOAT_COLOR", "CORNER"), ("FLOAT_COLOR", "FACE")]


@pytest.mark.parametrize(("kind", "domain"), OTHER_TYPES)
def test_an_attribute_of_our_name_and_another_type_has_no_parts(suzanne, kind, domain):
    suzanne.data.attributes.new("wcd_part", kind, domain)
    suzanne.data.attributes.new("wcd_hand", kind, domain)
    assert part_labels(suzanne) is None
    with pytest.raises(DecompositionError, match="vertex group wcd_part that"):
        decompose_by_hand(suzanne, 2)


@pytest.mark.parametrize(("kind", "domain"), OTHER_TYPES)
def test_an_attribute_with_the_name_of_slots_is_refused(suzanne, kind, domain):
    if suzanne.data.attributes.new("material_index", kind, domain) is None:
        return  # Blender 4.2 refuses it
    before = snapshot(suzanne)
    with pytest.raises(DecompositionError, match="attribute material_index that is"):
        decompose_by_hand(suzanne, 2)
    assert snapshot(suzanne) == before


def test_a_users_group_of_our_name_is_refused(suzanne):
    suzanne.vertex_groups.new(name="wcd_part")
    before = snapshot(suzanne)
    with pytest.raises(DecompositionError, match="vertex group wcd_part that"):
        decompose_by_hand(suzanne, 2)
    assert snapshot(suzanne) == before


@pytest.mark.parametrize("value", ["not JSON", 3, "[1]", '{"parts": [{}]}'])
def test_a_users_property_of_our_name_is_refused(suzanne, value):
    for owner, key in ((suzanne, "wcd"), (suzanne.data, "wcd_restore")):
        owner[key] = value
        before = snapshot(suzanne)
        with pytest.raises(DecompositionError, match=f"custom property {key} that"):
            decompose_by_hand(suzanne, 2)
        with pytest.raises(DecompositionError, match=f"custom property {key} that"):
            erase.clear(suzanne)
        assert snapshot(suzanne) == before
        del owner[key]


def test_labels_of_another_mesh_are_refused(suzanne):
    before = snapshot(suzanne)
    with pytest.raises(DecompositionError, match="was changed"):
        write.write_parts(suzanne, decomposition_of([0, 1]), Parameters())
    assert snapshot(suzanne) == before
