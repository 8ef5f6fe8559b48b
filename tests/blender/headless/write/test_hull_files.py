import json
import struct
import xml.etree.ElementTree as ET
from functools import cache

import bpy
import numpy as np
import pytest
from hand_made import in_scene
from headless.command import run_wcd
from headless.loading import load
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of
from weak_convex_decomposition.operators.headless.request.options import parse

QUICK = ["--samples=100", "--parts=2", "--max-hulls=3", "--naming=unreal"]
NAMES = ["UCX_Suzanne_01", "UCX_Suzanne_02", "UCX_Suzanne_03"]


def add_suzanne():
    bpy.ops.mesh.primitive_monkey_add(location=(1, 2, 3), rotation=(0.3, 0.5, 0))
    return bpy.context.active_object


@pytest.fixture
def model(tmp_path):
    add_suzanne()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "monkey.blend"), copy=True)
    return tmp_path / "monkey.blend"


def run(*arguments):
    return run_wcd(*arguments, "--quiet")


def boxes(objects):
    """Return the bounding box of each object's vertices in the world, by name."""
    bpy.context.view_layer.update()
    found = {}
    for obj in objects:
        places = in_scene(obj)
        found[obj.name] = np.concatenate([places.min(axis=0), places.max(axis=0)])
    return found


@cache
def hull_boxes():
    """Return the boxes of the hulls that the operator makes of the model."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    suzanne = add_suzanne()
    bpy.ops.wcd.decompose(samples=100, parts=2)
    bpy.ops.wcd.build_hulls(max_hulls=3, naming="UNREAL")
    return boxes(hulls_of(suzanne))


def assert_same(read, written):
    assert sorted(read) == sorted(written)
    for name, box in read.items():
        assert box == pytest.approx(written[name], abs=1e-4)


@pytest.mark.parametrize("ending", ["glb", "obj"])
def test_models_come_back_with_names_and_places(tmp_path, model, ending):
    path = tmp_path / f"hulls.{ending}"
    assert run(model, "--hulls", path, *QUICK, "--up=Z") == 0
    if ending == "glb":
        assert_marked_as_colliders(path.read_bytes())
    assert_same(boxes(load(path, "Z")), hull_boxes())


def test_hulls_lie_around_the_model_of_the_same_run(tmp_path, model):
    spans = []
    files = tmp_path / "model.obj", tmp_path / "hulls.obj"
    assert run(model, "--output", files[0], "--hulls", files[1], *QUICK) == 0
    for file in files:
        found = np.array(list(boxes(load(file, "Z")).values()))
        spans.append([*found[:, :3].min(axis=0), *found[:, 3:].max(axis=0)])
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    assert spans[0] == pytest.approx(spans[1], abs=0.02)


def assert_marked_as_colliders(glb):
    (length,) = struct.unpack_from("<I", glb, 12)
    scene = json.loads(glb[20 : 20 + length])
    assert struct.unpack_from("<I", glb, 8) == (len(glb),)
    assert scene["extensionsUsed"].count("KHR_physics_rigid_bodies") == 1
    nodes = scene["nodes"]
    assert sorted(node["name"] for node in nodes) == NAMES
    for number, node in enumerate(nodes):
        collider = node["extensions"]["KHR_physics_rigid_bodies"]["collider"]
        assert collider == {"geometry": {"node": number, "convexHull": True}}


def test_usd_comes_back_with_marks(tmp_path, model):
    path = tmp_path / "hulls.usd"
    assert run(model, "--hulls", path, *QUICK) == 0
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.wm.usd_import(filepath=str(path))
    meshes = [obj for obj in bpy.data.objects if obj.type == "MESH"]
    assert len(meshes) == 3
    read = boxes(meshes)
    expected = hull_boxes()
    # Names of prims and of meshes below them.
    assert sorted(name[: len(NAMES[0])] for name in read) == NAMES
    for name, box in read.items():
        assert box == pytest.approx(expected[name[: len(NAMES[0])]], abs=1e-4)
    assert_marked_as_convex(path)


def assert_marked_as_convex(path):
    text = path.read_text(encoding="utf-8")
    assert text.count('"PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"') == 3
    assert text.count('physics:approximation = "convexHull"') == 3


def test_stl_holds_hulls_of_collections_that_cannot_be_selected(tmp_path):
    collection = bpy.data.collections.new("Locked")
    bpy.context.scene.collection.children.link(collection)
    bpy.ops.mesh.primitive_cube_add()
    collection.objects.link(bpy.context.active_object)
    bpy.context.scene.collection.objects.unlink(bpy.context.active_object)
    collection.hide_select = True
    path, hulls = tmp_path / "locked.blend", tmp_path / "hulls.stl"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    assert run(path, f"--hulls={hulls}") == 0
    (read,) = load(hulls, "Z")
    assert len(read.data.vertices) == 8


def test_stl_holds_all_hulls(tmp_path, model):
    path = tmp_path / "hulls.stl"
    assert run(model, "--hulls", path, *QUICK) == 0
    ((_, box),) = boxes(load(path, "Z")).items()
    every = np.array(list(hull_boxes().values()))
    expected = np.concatenate([every[:, :3].min(axis=0), every[:, 3:].max(axis=0)])
    assert box == pytest.approx(expected, abs=1e-4)


@pytest.mark.parametrize(
    ("ending", "entries", "mesh", "attribute"),
    [
        ("urdf", "link/collision", "geometry/mesh", "filename"),
        ("xml", "asset/mesh", ".", "file"),
    ],
)
def test_simulators_get_a_file_a_hull(
    tmp_path, model, ending, entries, mesh, attribute
):
    path = tmp_path / f"hulls.{ending}"
    assert run(model, "--hulls", path, *QUICK) == 0
    root = ET.parse(path).getroot()
    found = [e for e in root.findall(entries) if e.get("name") in NAMES]
    files = {e.get("name"): tmp_path / e.find(mesh).get(attribute) for e in found}
    assert list(files) == NAMES
    read = {}
    for name, file in files.items():
        ((_, read[name]),) = boxes(load(file, "Z")).items()
    assert_same(read, hull_boxes())
    if ending == "xml":
        assert [
            g.get("mesh") for g in root.iter("geom") if g.get("mesh") in NAMES
        ] == NAMES


def test_the_report_and_the_model(tmp_path, model):
    report, output = tmp_path / "r.json", tmp_path / "parts.blend"
    words = ["--hulls", tmp_path / "h.glb", "--report", report, "--output", output]
    assert run(model, *words, *QUICK) == 0
    (entry,) = json.loads(report.read_text())["inputs"]
    assert entry["hulls"] == str(tmp_path / "h.glb")
    (result,) = entry["objects"]
    assert [hull["name"] for hull in result["hulls"]["hulls"]] == NAMES
    # The model is what it is without hulls.
    assert [obj.name for obj in load(output)] == ["Suzanne"]


def test_a_format_adds_its_ending(tmp_path):
    for word, given, file in (
        ("mjcf", "hulls", "hulls.xml"),
        ("URDF", "hulls", "hulls.urdf"),
        ("obj", "a.obj", "a.obj"),
    ):
        hulls = str(tmp_path / given)
        request = parse(["a.off", "--hulls", hulls, "--hulls-format", word], "wcd")
        assert request.targets[0].hulls == tmp_path / file, word


@pytest.mark.parametrize(
    ("options", "note"),
    [
        ("--shape=box --max-error=.1", "--shape, --max-error change nothing without"),
        ("--hulls=a.glb --density=5", "--density changes nothing without --hulls FILE"),
        ("--hulls=a.glb --template={n}", "--template changes nothing without --naming"),
        ("--hulls=a.xml --density=5 --margin=0 --seed=2", ""),
        ("--hulls=a.xml --parts=5", "--parts changes nothing for hulls without"),
        ("--hulls=a.xml --parts=5 --pieces=parts", ""),
        ("--output=a.obj --processes=2", "--processes changes nothing without --hulls"),
        ("--output=a.glb --with-hulls --processes=2", ""),
        ("--output=a.glb --up=y", ""),
        ("--hulls=a.xml --parts=5 --picture=a.png", ""),
    ],
)
def test_options_that_change_nothing_are_named(options, note):
    notes = parse(["a.off", *options.split()], "wcd").notes
    assert [note in each for each in notes] == ([True] if note else [])


@pytest.mark.parametrize(
    ("arguments", "is_of_use"),
    [
        ("a.glb --output=b.fbx --up=y", False),
        ("a.glb --hulls=b.urdf --up=y", False),
        ("a.glb --hulls=b.stl --up=y", True),
        ("a.glb b.PTS --up=y", True),
        ("a.blend --output=b.ply --up=z", True),
    ],
)
def test_an_axis_that_no_file_needs_is_named(arguments, is_of_use):
    notes = parse(arguments.split(), "wcd").notes
    assert ["--up changes nothing without a file in .obj" in n for n in notes] == (
        [] if is_of_use else [True]
    )


def test_wrong_usage(tmp_path, model, capsys):
    assert run(model, "--hulls=-", "--hulls-format=stl") == 2
    assert "standard output" in capsys.readouterr().err
    assert run(model, "--hulls", tmp_path / "a.ply") == 2
    assert "--hulls has to end in one of" in capsys.readouterr().err
    assert run(model, "--hulls", tmp_path / "a.glb", "--max-hulls=0") == 2
    said = capsys.readouterr().err
    assert "Most Hulls is 0" in said
    assert "(Most Hulls is --max-hulls.)" in said
    assert run(model, "--hulls-format=obj") == 2
    assert "--hulls-format needs --hulls" in capsys.readouterr().err
    words = ["--naming=template", "--template={name}"]
    assert run(model, "--hulls", tmp_path / "a.glb", *words) == 2
    assert "gives all hulls one name" in capsys.readouterr().err


def test_hulls_of_a_model_are_built_anew(tmp_path, model):
    (suzanne,) = load(model)
    bpy.context.view_layer.objects.active = suzanne
    bpy.ops.wcd.build_hulls(max_hulls=2, naming="UNREAL")
    bpy.ops.wm.save_as_mainfile(filepath=str(model))
    path, output = tmp_path / "hulls.obj", tmp_path / "parts.blend"
    assert run(model, "--hulls", path, "--output", output, *QUICK) == 0
    assert_same(boxes(load(path)), hull_boxes())
