"""Files whose objects have parts already, and files that get none."""

import json

import bpy
import pytest
from headless.command import run_wcd
from headless.loading import load
from weak_convex_decomposition.operators.bridge.parts.read import part_labels

QUICK = ["--samples=100", "--parts=5", "--quiet"]


@pytest.fixture
def model(tmp_path):
    """Return a file with an object in three parts, all of them locked."""
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.active_object
    bpy.ops.wcd.decompose(samples=100, parts=3)
    for row in obj.wcd_parts:
        row.locked = True
    path = tmp_path / "parts.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    return path, part_labels(obj)


def run(*arguments):
    return run_wcd(*arguments, *QUICK)


def test_hulls_of_parts_take_them_as_they_are(tmp_path, model, capfd):
    report = tmp_path / "r.json"
    hulls = ["--hulls", tmp_path / "hulls.glb", "--pieces=parts"]
    assert run(model[0], *hulls, "--report", report) == 0
    assert "locked" not in capfd.readouterr().err
    (entry,) = json.loads(report.read_text())["inputs"]
    (obj,) = entry["objects"]
    assert [hull["part"] for hull in obj["hulls"]["hulls"]] == [0, 1, 2]


def test_a_file_whose_parts_are_all_locked_is_written(tmp_path, model, capfd):
    output = tmp_path / "out.blend"
    assert run(model[0], "--output", output) == 0
    assert "All parts are locked" in capfd.readouterr().err
    (obj,) = load(output)
    assert (part_labels(obj) == model[1]).all()


def test_a_file_that_lacks_its_hulls_is_named(tmp_path, capfd):
    cloud, output = tmp_path / "cloud.xyz", tmp_path / "out.glb"
    cloud.write_text("".join(f"{x} {y} {x * y}\n" for x in range(9) for y in range(9)))
    assert run(cloud, "--output", output, "--with-hulls") == 1
    assert "out.glb was not written" in capfd.readouterr().err
    assert not output.exists()


def test_fbx_of_ours_with_colors_of_parts_is_read_again(tmp_path, capfd):
    bpy.ops.mesh.primitive_monkey_add()
    bpy.ops.wcd.decompose(samples=100, parts=3)
    bpy.ops.wcd.color_attribute()
    first, second = tmp_path / "a.blend", tmp_path / "b.fbx"
    bpy.ops.wm.save_as_mainfile(filepath=str(first), copy=True)
    assert run(first, "--output", second) == 0
    assert run(second, "--output", tmp_path / "c.glb") == 0
    assert "error" not in capfd.readouterr().err
