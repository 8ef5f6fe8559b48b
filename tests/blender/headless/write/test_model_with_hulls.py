"""One file with the model and its hulls; what engines and validators find in it."""

import os
import subprocess
import sys

import bpy
import numpy as np
import pytest
import trimesh
from checkout import ROOT
from hand_made import add_ring, build_hulls, decompose_by_hand, in_scene
from headless.command import run_wcd
from headless.loading import load
from weak_convex_decomposition.operators.bridge.hulls.listed import is_hull
from weak_convex_decomposition.operators.headless.formats import HULLS_WITHIN_ENDINGS
from weak_convex_decomposition.operators.headless.read.known_hulls import hull_note
from weak_convex_decomposition.operators.headless.write.model_files import save

# Writes the model with hulls, and the hulls, in every format but .blend.
WRITE = """
import os
import sys
from pathlib import Path
import bpy
root, model, folder = map(Path, sys.argv[1:])
sys.path.insert(0, str(root / "tests/support"))
import checkout
import hand_made
from headless.loading import load
import weak_convex_decomposition as package
from weak_convex_decomposition.core.parameters.bodies import BodyParameters
from weak_convex_decomposition.operators.headless import formats
from weak_convex_decomposition.operators.headless.write.hull_files import save_hulls
from weak_convex_decomposition.operators.headless.write.model_files import save
package.register()
objects = load(model)
for obj in objects:
    hand_made.decompose_by_hand(obj, 2)
hulls = hand_made.build_hulls(objects, max_hulls=2)
for ending in formats.MODEL_ENDINGS[1:]:
    within = ending in formats.HULLS_WITHIN_ENDINGS
    save(folder / f"model{ending}", None, hulls if within else ())
for ending in formats.HULL_ENDINGS:
    save_hulls(folder / f"hulls{ending}", hulls, "Z", BodyParameters())
os._exit(0)  # Blender 4.2 may crash when Python ends
"""
VALIDATE = """
import sys
from pxr import Usd, UsdValidation
stage = Usd.Stage.Open(sys.argv[1])
validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
errors = UsdValidation.ValidationContext(validators).Validate(stage)
print(*[error.GetMessage() for error in errors], sep="\\n")
"""


def add_models():
    """Add two objects whose names are the same where spaces are not legal."""
    ring = add_ring("A b")
    bpy.ops.object.shade_smooth()
    bpy.ops.mesh.primitive_cube_add(location=(5, 0, 0), rotation=(0, 0.2, 0.3))
    bpy.context.active_object.name = "A_b"
    return [ring, bpy.context.active_object]


@pytest.fixture
def built():
    """Return two objects with parts and hulls, and the hulls."""
    objects = add_models()
    for obj in objects:
        decompose_by_hand(obj, 2)
    return objects, build_hulls(objects, max_hulls=2)


def places(objects):
    """Return the vertices of each object in the world, by name, sorted."""
    bpy.context.view_layer.update()
    found = {}
    for obj in objects:
        points = in_scene(obj)
        found[obj.name] = np.unique(points.round(4), axis=0)
    return found


@pytest.mark.parametrize("ending", HULLS_WITHIN_ENDINGS)
def test_hulls_come_along_and_are_no_models(tmp_path, built, ending):
    objects, hulls = built
    names, expected = [obj.name for obj in objects], places(hulls)
    path = tmp_path / f"both{ending}"
    save(path, None, hulls)
    still = places(hulls)
    assert still.keys() == expected.keys()
    assert all((still[name] == expected[name]).all() for name in still)
    assert all(hull.parent in objects for hull in hulls)
    assert not any(p.use_smooth for hull in hulls for p in hull.data.polygons)
    if ending == ".usd":
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        bpy.ops.wm.usd_import(filepath=str(path), import_guide=True)
        found = [obj for obj in bpy.data.objects if "hull" in obj.name]
        assert len(bpy.data.meshes) == 2 + len(hulls)
    else:
        assert [obj.name for obj in load(path)] == names
        found = [obj for obj in bpy.data.objects if is_hull(obj)]
    read = sorted(map(np.ravel, places(found).values()), key=len)
    written = sorted(map(np.ravel, expected.values()), key=len)
    assert len(read) == len(written)
    for one, other in zip(read, written, strict=True):
        assert sorted(one) == pytest.approx(sorted(other), abs=1e-3)


def test_fbx_has_the_names_of_unreal_and_no_parents(tmp_path, built):
    _, hulls = built
    save(tmp_path / "both.fbx", None, hulls)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.import_scene.fbx(filepath=str(tmp_path / "both.fbx"))
    names = {obj.name for obj in bpy.data.objects}
    assert names == {"A b", "A_b", "UCX_A b_01", "UCX_A b_02", "UCX_A_b_01"}
    assert not any(obj.parent for obj in bpy.data.objects)


def test_hulls_share_vertices_in_glb(tmp_path, built, checked_glb):
    _, hulls = built
    path = tmp_path / "both.glb"
    save(path, None, hulls)
    scene, arrays = checked_glb(path)
    colliders = [node for node in scene["nodes"] if "extensions" in node]
    assert {node["name"] for node in colliders} == {hull.name for hull in hulls}
    for node in colliders:
        (primitive,) = scene["meshes"][node["mesh"]]["primitives"]
        points = arrays[primitive["attributes"]["POSITION"]]
        assert len(points) == len(bpy.data.objects[node["name"]].data.vertices)
    read = trimesh.load(path)
    assert sum(mesh.is_volume for mesh in read.geometry.values()) >= len(hulls)


def test_usd_passes_its_validators(tmp_path, built):
    objects, hulls = built
    path = tmp_path / "both.usd"
    save(path, None, hulls)
    command = [sys.executable, "-c", VALIDATE, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""
    text = path.read_text(encoding="utf-8")
    assert text.count('token purpose = "guide"') == len(hulls)
    assert text.count("def GeomSubset") == 2 * len(objects)
    assert 'displayName = "A b"' in text


def test_two_processes_write_the_same_bytes(tmp_path):
    add_models()
    model = tmp_path / "two.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    written = []
    for seed in ("1", "2"):
        folder = tmp_path / seed
        folder.mkdir()
        command = [sys.executable, "-c", WRITE, str(ROOT), str(model), str(folder)]
        environment = os.environ | {"PYTHONHASHSEED": seed}
        subprocess.run(command, env=environment, capture_output=True, check=True)
        files = sorted(path for path in folder.rglob("*") if path.is_file())
        written.append({f.relative_to(folder): f.read_bytes() for f in files})
    one, other = written
    assert len(one) > 15
    assert one.keys() == other.keys()
    assert [str(name) for name, data in one.items() if data != other[name]] == []


def test_a_model_without_hulls_is_not_written_as_if_it_had_some(tmp_path, capsys):
    _, cube = add_models()
    cube.name = "UCX_A b_01_of_a_user"
    for name in ("A b", cube.name):
        bpy.data.objects.new(f"{name} hull 01", None).use_fake_user = True
    model, output = tmp_path / "two.blend", tmp_path / "both.glb"
    output.write_text("earlier")
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    words = [model, "--output", output, "--with-hulls", "--samples=60", "--parts=2"]
    assert run_wcd(*words, "--quiet") == 1
    assert "There is an object A b hull 01 already" in capsys.readouterr().err
    assert output.read_text() == "earlier"


def test_wrong_usage(tmp_path, capsys):
    for words, sentence in (
        (["--with-hulls"], "--with-hulls needs --output"),
        (["--with-hulls", "--output", "a.obj"], "has to end in one of .blend .glb"),
    ):
        assert run_wcd("a.off", *words) == 2
        assert sentence in capsys.readouterr().err


def test_hulls_of_others_are_known_by_name(tmp_path, capsys):
    add_models()
    bpy.ops.mesh.primitive_cube_add(location=(1, 2, 3))
    bpy.context.active_object.name = "UCX_A b_01"
    bpy.ops.mesh.primitive_cube_add(location=(9, 0, 0))
    bpy.context.active_object.name = "UCX_nobody_01"
    place = places([bpy.data.objects["UCX_A b_01"]])
    bpy.ops.export_scene.fbx(filepath=str(tmp_path / "a.fbx"))
    objects = load(tmp_path / "a.fbx")
    assert [obj.name for obj in objects] == ["A b", "A_b", "UCX_nobody_01"]
    hull = bpy.data.objects["UCX_A b_01"]
    assert hull.parent == objects[0]
    assert places([hull])["UCX_A b_01"] == pytest.approx(place["UCX_A b_01"], abs=1e-4)
    assert "UCX_A b_01" in hull_note()
