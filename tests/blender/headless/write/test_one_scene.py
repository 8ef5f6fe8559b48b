"""Outputs hold all that is worked on, hidden or in another scene, and nothing else."""

import json
import struct

import bpy
import numpy as np
import pytest
from hand_made import build_hulls, in_scene
from headless.command import run_wcd
from headless.loading import load
from weak_convex_decomposition.operators.headless.write.one_scene import one_scene

QUICK = ["--samples=60", "--parts=1", "--quiet"]
# Where the cubes are along x.
SHOWN = {"seen": 0, "off": 10, "by eye": 20, "in hidden": 30, "elsewhere": 40}
SPANS = [(x - 1, x + 1) for x in SHOWN.values()]


def cube(name, x, scene=None, collection=None):
    """Return a cube in a collection, or that of a scene."""
    bpy.ops.mesh.primitive_cube_add(location=(x, 0, 0))
    obj = bpy.context.active_object
    obj.name = obj.data.name = name
    if scene or collection:
        bpy.context.scene.collection.objects.unlink(obj)
        (collection or scene.collection).objects.link(obj)
    return obj


def add_cubes():
    """Add the cubes of `SHOWN`, hidden in all ways, and an excluded one."""
    hidden, excluded = (bpy.data.collections.new(n) for n in ("Hidden", "Excluded"))
    for each in (hidden, excluded):
        bpy.context.scene.collection.children.link(each)
    hidden.hide_viewport = True
    cube("seen", 0)
    cube("off", 10).hide_viewport = True
    cube("by eye", 20).hide_set(True)
    cube("in hidden", 30, collection=hidden)
    cube("elsewhere", 40, scene=bpy.data.scenes.new("Another"))
    cube("excluded", 50, collection=excluded)
    bpy.context.view_layer.layer_collection.children["Excluded"].exclude = True


def add_to_excluded(obj):
    """Move an object of the scene to a collection that is excluded."""
    excluded = bpy.data.collections.new("Excluded")
    bpy.context.scene.collection.children.link(excluded)
    bpy.context.scene.collection.objects.unlink(obj)
    excluded.objects.link(obj)
    bpy.context.view_layer.layer_collection.children["Excluded"].exclude = True


def model_in(tmp_path):
    path = tmp_path / "model.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    return path


def spans(objects):
    """Return where each object begins and ends along x, in their order there."""
    ends = []
    for obj in objects:
        x = in_scene(obj)[:, 0]
        ends.append((x.min(), x.max()))
    return sorted(ends)


@pytest.mark.parametrize("ending", ["obj", "glb", "usd", "fbx"])
def test_hidden_objects_and_other_scenes_are_written(tmp_path, ending):
    add_cubes()
    output = tmp_path / f"parts.{ending}"
    assert run_wcd(model_in(tmp_path), f"--output={output}", *QUICK) == 0
    found = spans(load(output, "Z" if ending == "usd" else None))
    assert np.array(found) == pytest.approx(np.array(SPANS), abs=1e-4)


def test_ply_holds_them_too(tmp_path):
    add_cubes()
    output = tmp_path / "parts.ply"
    assert run_wcd(model_in(tmp_path), f"--output={output}", *QUICK) == 0
    assert spans(load(output)) == [(-1, 41)]


def test_hulls_for_unreal_have_their_models(tmp_path):
    add_cubes()
    output = tmp_path / "parts.fbx"
    words = [f"--output={output}", "--with-hulls", *QUICK]
    assert run_wcd(model_in(tmp_path), *words) == 0
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.import_scene.fbx(filepath=str(output))
    names = {obj.name for obj in bpy.data.objects}
    assert names == {*SHOWN, *(f"UCX_{name}_01" for name in SHOWN)}


def test_a_file_with_nothing_in_sight_is_written(tmp_path):
    cube("off", 0).hide_viewport = True
    output = tmp_path / "parts.obj"
    assert run_wcd(model_in(tmp_path), f"--output={output}", *QUICK) == 0
    assert [obj.name for obj in load(output)] == ["off"]


def test_glb_has_one_scene_and_what_its_objects_hang_on(tmp_path):
    add_cubes()
    empty = bpy.data.objects.new("holder", None)
    bpy.data.collections["Excluded"].objects.link(empty)
    bpy.data.objects["seen"].parent = empty
    output = tmp_path / "parts.glb"
    assert run_wcd(model_in(tmp_path), f"--output={output}", *QUICK) == 0
    data = output.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    content = json.loads(data[20 : 20 + length])
    assert [scene["name"] for scene in content["scenes"]] == ["Scene"]
    assert {node["name"] for node in content["nodes"]} == {*SHOWN, "holder"}


@pytest.mark.parametrize("ending", ["glb", "obj", "fbx", "usd", "ply", "blend"])
def test_hulls_of_an_earlier_run_are_left_out(tmp_path, ending):
    ring, _ = cube("Ring", 0), cube("Other", 10)
    build_hulls([ring], max_hulls=1)
    output = tmp_path / f"again.{ending}"
    assert run_wcd(model_in(tmp_path), f"--output={output}", *QUICK) == 0
    load(output, "Z" if ending == "usd" else None)
    meshes = [each.data for each in bpy.data.objects if each.type == "MESH"]
    faces = [len(mesh.polygons) for mesh in meshes]
    whole = 12 if ending == "glb" else 6
    assert sum(faces) == 2 * whole + (12 if ending == "blend" else 0)


def test_hulls_that_are_built_are_written_alone(tmp_path):
    ring, other = cube("Ring", 0), cube("Other", 10)
    build_hulls([ring, other], max_hulls=1)
    other.data.clear_geometry()  # its hull is not built again
    cube("excluded", 50).parent = ring
    add_to_excluded(bpy.data.objects["excluded"])
    output = tmp_path / "both.glb"
    words = [f"--output={output}", "--with-hulls", *QUICK]
    assert run_wcd(model_in(tmp_path), *words) == 0
    load(output)
    names = sorted(each.name for each in bpy.data.objects)
    assert names == ["Other", "Ring", "Ring hull 01"]


def test_the_scene_of_the_user_is_as_it_was():
    add_cubes()
    scene = bpy.context.scene
    before = [(obj.name, obj.hide_viewport) for obj in bpy.data.objects]
    with one_scene():
        assert bpy.context.scene != scene
        assert all(obj.visible_get() for obj in bpy.context.scene.objects)
    assert bpy.context.scene == scene
    assert [each.name for each in bpy.data.scenes] == ["Another", "Scene"]
    assert before == [(obj.name, obj.hide_viewport) for obj in bpy.data.objects]
    assert bpy.data.objects["by eye"].hide_get()


def test_objects_without_a_place_are_named_and_left_out(tmp_path, capsys):
    cube("seen", 0)
    cube("nowhere", np.nan)
    model, report = model_in(tmp_path), tmp_path / "report.json"
    for ending in ("glb", "obj", "usd", "fbx", "ply"):
        output, hulls = tmp_path / f"a.{ending}", tmp_path / "hulls.glb"
        words = [f"--output={output}", f"--hulls={hulls}", f"--report={report}"]
        assert run_wcd(model, *words, *QUICK) == 1
        assert "nowhere: The object's location" in capsys.readouterr().err
        assert len(load(output)) == len(load(hulls)) == 1
    entries = json.loads(report.read_text())["inputs"][0]["objects"]
    assert [bool(each["error"]) for each in entries] == [True, False]
