import json
import math
import os
import shutil
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import bpy
import pytest
from edited import record_of
from headless.command import run_wcd
from weak_convex_decomposition.core.parameters.parameter import info_of
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parameters.presets import preset
from weak_convex_decomposition.operators.headless.request.option_names import SETTINGS
from weak_convex_decomposition.operators.headless.request.options import parse
from weak_convex_decomposition.operators.headless.write import picture

ROOT = Path(__file__).parents[3]
QUICK = ["--samples", "100", "--parts", "2"]


@pytest.fixture
def model(tmp_path):
    bpy.ops.mesh.primitive_monkey_add()
    bpy.ops.wm.obj_export(filepath=str(tmp_path / "monkey.obj"))
    return tmp_path / "monkey.obj"


def test_help_explains_every_parameter_with_its_default(capsys):
    assert run_wcd("--help") == 0
    words = " ".join(capsys.readouterr().out.split())
    settings = [field for kind in SETTINGS for field in fields(kind)]
    for field in settings:
        assert f"--{field.name.replace('_', '-')} " in words
        assert " ".join(info_of(field).help.split()) in words
    assert words.count("(default: ") >= len(settings)
    assert "{name}" in words


def test_each_choice_has_a_line_in_the_help(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert run_wcd("--help") == 0
    lines = [line.strip() for line in capsys.readouterr().out.splitlines()]
    for word in ("all-pairs", "cone", "paper", "filled", "unreal"):
        assert [line for line in lines if line.startswith(f"{word}: ")], word


def test_version(capsys):
    assert run_wcd("--version") == 0
    version = (ROOT / "blender_manifest.toml").read_text().split('\nversion = "')[1]
    assert capsys.readouterr().out.strip().endswith(version.split('"')[0])


def test_without_options_parameters_have_their_defaults():
    assert parse(["a.obj"], "wcd").parameters == Parameters()


def test_options_reach_the_parameters():
    arguments = "a.obj --parts 4 --cone-angle 60 --sight CONE --psi-pairs rays"
    parameters = parse(arguments.split(), "wcd").parameters
    assert parameters.parts == 4
    assert parameters.cone_angle == pytest.approx(math.radians(60))
    assert (parameters.sight, parameters.psi_pairs) == ("CONE", "RAYS")
    parameters = parse(["a.obj", "--sight", "All_Pairs"], "wcd").parameters
    assert parameters == Parameters(sight="ALL_PAIRS")


def test_options_change_a_preset():
    parameters = parse(["a.obj", "--alpha=3", "--preset=paper"], "wcd").parameters
    assert parameters == preset("PAPER").parameters(alpha=3.0)


def test_wrong_usage_is_explained_and_writes_nothing(tmp_path, capsys):
    cases = [
        ("", "INPUT"),
        ("a.obj --part 3", "unrecognized"),
        ("a.obj --parts many", "'many' is not a whole number"),
        ("a.obj --parts 1_0", "'1_0' is not a whole number"),
        ("a.obj --alpha ٢", "'٢' is not a number"),
        ("a.obj --parts 1000", "Parts is 1000; choose a value from 0 to 256."),
        ("a.obj --cone-angle 181", "181 is not from 1 to 180 degrees"),
        ("a.obj --cone-angle wide", "'wide' is not a number"),
        ("a.obj --cone-angle nan", "nan is not from 1 to 180 degrees"),
        ("a.obj --alpha nan", "must be a number"),
        (
            "a.obj --hulls {tmp}/b.glb --processes 0",
            "argument --processes: 0 is less than 1",
        ),
        ("a.obj --sight far", "not one of blocks, all-pairs, cone"),
        ("a.obj --min-parts 9 --max-parts 3", "above Most Parts"),
        ("a.obj --output {tmp}/b.stl", "--output has to end in one of .blend"),
        ("a.obj --picture {tmp}/b.jpg", "--picture has to end in one of .png"),
        ("a.obj b.obj --output {tmp}/b.glb", "--output needs {name}"),
        ("a.obj x/a.off --output {tmp}/{name}.glb", "written twice"),
        ("{tmp}/a.obj --output {tmp}/a.obj", "is an input, too"),
        ("a.obj --hulls {tmp}/b.glb --output {tmp}/b.glb", "written twice"),
        ("a.obj --report {tmp}", "is a folder"),
        ("a.obj --report=", "argument --report: it is empty; name a file"),
    ]
    for arguments, message in cases:
        status = run_wcd(*arguments.replace("{tmp}", str(tmp_path)).split())
        out, err = capsys.readouterr()
        assert (status, out) == (2, ""), arguments
        assert message in err, arguments
        assert err.startswith("error: "), arguments
        assert err.endswith("All options: blender --command wcd --help\n"), arguments
        assert err.count("\n") == 2, arguments
        assert list(tmp_path.iterdir()) == [], arguments


def test_one_input_all_results(tmp_path, model, capfd):
    report, output = tmp_path / "r.json", tmp_path / "out.blend"
    capfd.readouterr()  # what Blender said about making the input
    status = run_wcd(model, "--output", output, "--report", report, *QUICK, "--seed", 5)
    out, err = capfd.readouterr()
    assert status == 0
    assert out.startswith(f"{model}, Suzanne: 2 parts, psi ")
    assert out.count("\n") == 1
    assert err.startswith(f"{model}, Suzanne: ")
    (entry,) = json.loads(report.read_text())["inputs"]
    (result,) = entry["objects"]
    assert (entry["input"], entry["output"]) == (str(model), str(output))
    assert entry["errors"] == []
    assert (result["seed"], result["k"], len(result["parts"])) == (5, 2, 2)
    bpy.ops.wm.open_mainfile(filepath=str(output))
    record = record_of(bpy.data.objects["Suzanne"])
    told, parts = result.pop("parts"), record.pop("parts")
    assert record.items() <= result.items()
    assert all(
        one.items() <= other.items() for one, other in zip(told, parts, strict=True)
    )
    assert sum(part["faces"] for part in parts) == 500


def test_the_operator_gives_the_same_parts(tmp_path, model):
    assert run_wcd(model, "--output", tmp_path / "out.blend", *QUICK) == 0
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.wm.obj_import(filepath=str(model))
    obj = bpy.context.active_object
    bpy.ops.wcd.decompose(samples=100, parts=2)
    by_operator = [d.value for d in obj.data.attributes["wcd_part"].data]
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    mesh = bpy.data.objects["Suzanne"].data
    assert [d.value for d in mesh.attributes["wcd_part"].data] == by_operator


def test_what_fails_leaves_the_rest_and_its_own_files_alone(tmp_path, model, capfd):
    bad = tmp_path / "bad.ply"
    bad.write_bytes(b"ply\nnonsense")
    (tmp_path / "bad.glb").write_text("earlier")
    report = tmp_path / "r.json"
    pattern = tmp_path / "{name}.glb"
    status = run_wcd(
        bad, "none.obj", model, "--output", pattern, "--report", report, *QUICK
    )
    out, err = capfd.readouterr()
    assert status == 1
    assert out.count("\n") == 1
    errors = [line for line in err.splitlines() if line.startswith("error: ")]
    assert len(errors) == 2
    assert "Traceback" not in err
    assert (tmp_path / "bad.glb").read_text() == "earlier"
    assert (tmp_path / "monkey.glb").stat().st_size > 10_000
    assert not (tmp_path / "none.glb").exists()
    entries = json.loads(report.read_text())["inputs"]
    assert [f"error: {e}" for entry in entries for e in entry["errors"]] == errors
    assert [entry["output"] is None for entry in entries] == [True, True, False]


def test_every_object_is_decomposed_once(tmp_path, capfd):
    bpy.ops.mesh.primitive_monkey_add()
    first = bpy.context.active_object
    shared = bpy.data.objects.new("Twin", first.data)
    wire = bpy.data.meshes.new("Wire")
    wire.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
    flat = bpy.data.meshes.new("Flat")
    flat.from_pydata([(0, 0, 0)] * 3, [], [(0, 1, 2)])
    for obj in (
        shared,
        bpy.data.objects.new("Wire", wire),
        bpy.data.objects.new("Flat", flat),
    ):
        bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.update()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"), copy=True)
    report = tmp_path / "r.json"
    capfd.readouterr()  # what Blender said about making the input
    assert run_wcd(tmp_path / "a.blend", "--report", report, "--quiet", *QUICK) == 1
    out, err = capfd.readouterr()
    assert out == ""
    assert "Suzanne: 2 objects share this mesh" in err
    assert "Wire: It has no faces" in err
    assert f"error: {tmp_path}/a.blend, Flat: " in err
    objects = json.loads(report.read_text())["inputs"][0]["objects"]
    assert [obj["name"] for obj in objects] == ["Flat", "Suzanne", "Twin", "Wire"]
    assert [bool(obj["error"]) for obj in objects] == [True, False, False, False]
    assert objects[1]["parts"] == objects[2]["parts"]


def test_picture_option(tmp_path, model, monkeypatch):
    monkeypatch.setattr(picture, "SIZE", 160)
    assert run_wcd(model, "--picture", tmp_path / "{name}.png", *QUICK, "--quiet") == 0
    assert (tmp_path / "monkey.png").read_bytes().startswith(b"\x89PNG")


def test_from_a_checkout_of_any_name(tmp_path, model):
    checkout = tmp_path / "my check-out"
    checkout.mkdir()
    for name in ("__init__.py", "__main__.py", "blender_manifest.toml"):
        shutil.copy(ROOT / name, checkout)
    for name in ("core", "operators", "ui"):
        shutil.copytree(ROOT / name, checkout / name)

    # Set by bpy in this process; another bpy would say that it found it.
    environment = {k: v for k, v in os.environ.items() if k != "OCIO"}

    def python_dot(*arguments):
        return subprocess.run(
            [sys.executable, ".", *map(str, arguments)],
            cwd=checkout,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=100,
        )

    done = python_dot(model, "missing.obj", "--output", tmp_path / "{name}.ply", *QUICK)
    assert done.returncode == 1
    assert done.stdout.startswith(f"{model}, Suzanne: 2 parts")
    assert done.stdout.count("\n") == 1
    assert "error: missing.obj does not exist." in done.stderr.splitlines()
    assert "Traceback" not in done.stderr
    assert (tmp_path / "monkey.ply").read_bytes().startswith(b"ply")
    assert python_dot(model, *QUICK, "--quiet").returncode == 0
    wrong = python_dot("--parts", "-1", model)
    assert wrong.returncode == 2
    assert wrong.stderr.endswith("All options: python . --help\n")
