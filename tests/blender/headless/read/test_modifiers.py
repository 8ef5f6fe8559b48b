"""--apply-modifiers: meshes as Blender shows them, and a note of what that did."""

import json

import bpy
import numpy as np
import pytest
from headless.command import run_wcd
from weak_convex_decomposition.operators.headless.read.load import load_file

QUICK = ["--samples", "60", "--parts", "1", "--quiet"]


def cube(name="Cube", place=(0, 0, 0)):
    bpy.ops.mesh.primitive_cube_add(location=place)
    obj = bpy.context.active_object
    obj.name = obj.data.name = name
    return obj


def loaded(tmp_path, apply=True):
    bpy.context.view_layer.update()
    path = tmp_path / "a.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    return load_file(path, None, apply)


def width(obj):
    return round(float(np.ptp([v.co.x for v in obj.data.vertices])), 4)


def test_the_option_reaches_parts_files_and_report(tmp_path, capsys):
    cube().modifiers.new("Finer", "SUBSURF").levels = 2
    path, output = tmp_path / "a.blend", tmp_path / "out.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    report = tmp_path / "r.json"
    words = [path, "--output", output, "--report", report, *QUICK, "--apply-modifiers"]
    assert run_wcd(*words) == 0
    note = "6 faces became 96; the parts are on the new ones."
    assert f"Cube: Its modifiers were applied: {note}" in capsys.readouterr().err
    (obj,) = json.loads(report.read_text())["inputs"][0]["objects"]
    assert sum(part["faces"] for part in obj["parts"]) == 96
    assert any(note in each for each in obj["notes"])
    bpy.ops.wm.open_mainfile(filepath=str(output))
    written = bpy.data.objects["Cube"]
    assert (len(written.data.polygons), len(written.modifiers)) == (96, 0)
    assert [mesh.name for mesh in bpy.data.meshes] == ["Cube"]


def test_without_the_option_modifiers_stay(tmp_path, capsys):
    cube().modifiers.new("Finer", "SUBSURF")
    path = tmp_path / "a.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    assert run_wcd(path, *QUICK) == 0
    err = capsys.readouterr().err
    assert "The mesh was read without its modifiers (Finer)" in err
    assert "(Mesh: Evaluated is --apply-modifiers.)" in err


@pytest.mark.parametrize("ending", ["glb", "fbx", "obj", "ply", "usd"])
def test_outputs_hold_the_mesh_that_parts_and_hulls_are_of(tmp_path, ending):
    cube().modifiers.new("Row", "ARRAY").count = 3
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"), copy=True)
    output = tmp_path / f"out.{ending}"
    assert run_wcd(tmp_path / "a.blend", f"--output={output}", *QUICK) == 0
    (read,) = load_file(output, "Z", with_modifiers=False).objects
    assert len(read.data.polygons) == (12 if ending == "glb" else 6)
    assert width(read) * read.scale.x == pytest.approx(2)


def test_shape_keys_and_armatures_are_applied_as_shown(tmp_path):
    keyed = cube("Keyed")
    keyed.shape_key_add(name="Basis")
    longer = keyed.shape_key_add(name="Longer")
    for vertex, point in zip(keyed.data.vertices, longer.data, strict=True):
        point.co = (3 * vertex.co.x, vertex.co.y, vertex.co.z)
    longer.value = 0.5
    bpy.ops.object.armature_add()
    rig = bpy.context.active_object
    rig.pose.bones[0].scale = (5, 1, 1)
    posed = cube("Posed")
    posed.vertex_groups.new(name="Bone").add(range(8), 1.0, "REPLACE")
    posed.modifiers.new("Rig", "ARMATURE").object = rig
    rig.hide_viewport = posed.hide_viewport = True
    file = loaded(tmp_path)
    keyed, posed = file.objects
    assert (width(keyed), width(posed)) == (4.0, 10.0)
    assert file.notes["Keyed"].startswith("Its shape keys were applied: the parts are")
    assert keyed.data.shape_keys is None
    assert [group.name for group in posed.vertex_groups] == ["Bone"]
    assert posed.data.vertices[0].groups[0].weight == 1.0
    assert posed.hide_viewport


def test_linked_copies_that_look_alike_still_share_a_mesh(tmp_path):
    first = cube()
    for number, width_of_bevel in enumerate((0.1, 0.1, 0.2)):
        obj = first if number == 0 else first.copy()
        if number:
            bpy.context.scene.collection.objects.link(obj)
            obj.modifiers.clear()
        obj.modifiers.new("Bevel", "BEVEL").width = width_of_bevel
    a, b, c = (obj.data for obj in loaded(tmp_path).objects)
    assert a == b != c


def test_instances_take_the_modifiers_of_their_source_where_it_is(tmp_path):
    target, source = cube("Target", (3, 0, 0)), cube("Source")
    mirror = source.modifiers.new("Mirror", "MIRROR")
    mirror.mirror_object, mirror.use_clip = target, False
    things = bpy.data.collections.new("Things")
    for obj in (target, source):
        bpy.context.scene.collection.objects.unlink(obj)
        things.objects.link(obj)
    for number in range(2):
        empty = bpy.data.objects.new("Spot", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", things
        empty.location.y = 10 * number
        bpy.context.scene.collection.objects.link(empty)
    file = loaded(tmp_path)
    sources = [obj for obj in file.objects if "Source" in obj.name]
    assert [width(obj) for obj in sources] == [8.0, 8.0]
    assert sources[0].data == sources[1].data
    assert not any(obj.modifiers for obj in file.objects)


def test_a_mesh_that_modifiers_empty_is_left_as_it_is(tmp_path, capsys):
    cube("Kept")
    gone = cube("Gone")
    mask = gone.modifiers.new("Mask", "MASK")
    mask.vertex_group = gone.vertex_groups.new(name="None").name
    path = tmp_path / "a.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    assert run_wcd(path, *QUICK, "--apply-modifiers") == 0
    err = capsys.readouterr().err
    assert "Gone: Its modifiers were applied: 6 faces became none." in err
    assert "Gone: It has no faces and was left as it is." in err


def test_earlier_parts_and_exploded_views_give_way(tmp_path):
    obj = cube()
    bpy.ops.wcd.decompose(samples=60, parts=2)
    bpy.ops.wcd.explode()
    obj.modifiers.new("Finer", "SUBSURF")
    path, output = tmp_path / "a.blend", tmp_path / "out.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    words = [path, "--output", output, *QUICK, "--apply-modifiers"]
    assert run_wcd(*words) == 0
    bpy.ops.wm.open_mainfile(filepath=str(output))
    written = bpy.data.objects["Cube"]
    assert width(written) < 2.0  # Subdivision Surface shrinks it
    assert [group.name for group in written.vertex_groups] == ["Part 01"]
