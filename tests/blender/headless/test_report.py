"""What --report writes: it fits its schema, and its figures are those of the scene."""

import json
import math
import re

import bpy
import jsonschema
import numpy as np
import pytest
from checkout import ROOT
from hand_made import in_scene
from headless.command import run_wcd
from mathutils import Euler, Matrix, Quaternion, Vector
from weak_convex_decomposition.operators.headless import command_line
from weak_convex_decomposition.operators.headless.stages import (
    STAGE_OF,
    STAGES,
    Stages,
    peak_memory,
)

SCHEMA = json.loads((ROOT / "docs/report.schema.json").read_text(encoding="utf-8"))
QUICK = ["--samples", "100", "--parts", "2", "--quiet"]


def reported(tmp_path, *arguments, status=0):
    """Run the command line; return its report, checked by the schema."""
    path = tmp_path / "report.json"
    assert run_wcd(*arguments, "--report", path) == status
    report = json.loads(path.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    jsonschema.validate(report, SCHEMA)
    jsonschema.validate(report, closed(SCHEMA))
    return report


def closed(schema):
    """Return a schema that allows no field it does not name."""
    if isinstance(schema, list):
        return [closed(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    found = {key: closed(each) for key, each in schema.items()}
    if isinstance(found.get("properties"), dict) and "required" in found:
        found["additionalProperties"] = False
    return found


def save(tmp_path, *objects):
    """Save a scene of these objects alone; return the file."""
    for obj in objects:
        bpy.context.collection.objects.link(obj)
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    return path


def block(name, size=(2, 1, 0.5), l_shaped=False):
    """Return an object: a box about the origin, or an L."""
    outline = [(0, 0), (1, 0), (1, 1), (0, 1)]
    if l_shaped:
        outline = [(0, 0), (1, 0), (1, 0.2), (0.2, 0.2), (0.2, 1), (0, 1)]
    n = len(outline)
    corners = [((x - 0.5), (y - 0.5), z) for z in (-0.5, 0.5) for x, y in outline]
    walls = [(i, (i + 1) % n, (i + 1) % n + n, i + n) for i in range(n)]
    faces = [tuple(range(n - 1, -1, -1)), tuple(range(n, 2 * n)), *walls]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata((np.array(corners) * size).tolist(), [], faces)
    return bpy.data.objects.new(name, mesh)


def test_parts_and_hulls_are_told_of(tmp_path):
    path = save(tmp_path, block("L", l_shaped=True))
    outputs = ["--output", tmp_path / "o.blend", "--hulls", tmp_path / "h.glb"]
    report = reported(tmp_path, path, *outputs, *QUICK, "--max-hulls", 2)
    assert (report["schema_version"], report["interrupted"]) == (1, False)
    assert report["parameters"]["samples"] == 100
    assert report["hull_parameters"]["max_hulls"] == 2
    (entry,) = report["inputs"]
    (found,) = entry["objects"]
    assert (found["k"], len(found["parts"])) == (2, 2)
    assert {hull["part"] for hull in found["hulls"]["hulls"]} <= {0, 1}
    stages = entry["stages"]
    assert list(stages) == list(STAGES)
    assert all(stage["seconds"] > 0 for stage in stages.values())
    assert sum(stage["seconds"] for stage in stages.values()) <= entry["seconds"]
    peaks = [stage["peak_memory"] for stage in stages.values()]
    assert all(50e6 < peak <= report["peak_memory"] < 50e9 for peak in peaks)
    assert 0 < found["seconds"] < entry["seconds"] <= report["seconds"]


def test_hulls_alone_need_no_parts(tmp_path, capfd):
    path = save(tmp_path, block("L", l_shaped=True))
    words = [path, "--hulls", tmp_path / "h.glb"]
    report = reported(tmp_path, *words, "--samples", 100)
    out, err = capfd.readouterr()
    assert "psi" not in out
    assert "Lines of sight" not in err
    (entry,) = report["inputs"]
    (found,) = entry["objects"]
    assert found["parts"] is None
    assert {hull["part"] for hull in found["hulls"]["hulls"]} == {None}
    for stage in ("lines_of_sight", "clusters", "seams"):
        assert entry["stages"][stage] is None, stage
    for more in (["--pieces", "parts"], ["--output", tmp_path / "o.blend"]):
        (entry,) = reported(tmp_path, *words, *QUICK, *more)["inputs"]
        assert len(entry["objects"][0]["parts"]) == 2, more
        assert entry["stages"]["lines_of_sight"]["seconds"] > 0


def test_what_fails_is_told_and_the_rest_is_done(tmp_path, capfd):
    flat = bpy.data.meshes.new("Flat")
    flat.from_pydata([(0, 0, 0)] * 3, [], [(0, 1, 2)])
    wire = bpy.data.meshes.new("Wire")
    wire.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
    others = [bpy.data.objects.new(mesh.name, mesh) for mesh in (flat, wire)]
    path = save(tmp_path, block("Box"), *others)
    hulls = tmp_path / "{name}.glb"
    report = reported(tmp_path, path, tmp_path / "none.obj", "--hulls", hulls, status=1)
    scene, missing = report["inputs"]
    assert (missing["objects"], missing["hulls"]) == ([], None)
    assert "does not exist" in missing["errors"][0]
    assert (scene["errors"], scene["hulls"]) == ([], str(tmp_path / "scene.glb"))
    by_name = {each["name"]: each for each in scene["objects"]}
    assert list(by_name) == ["Box", "Flat", "Wire"]
    assert "no area" in by_name["Flat"]["error"]
    assert by_name["Flat"]["hulls"] is by_name["Wire"]["hulls"] is None
    assert "no faces" in by_name["Wire"]["notes"][0]
    assert len(by_name["Box"]["hulls"]["hulls"]) == 1
    errors = re.findall("^error: .*$", capfd.readouterr().err, re.M)
    assert len(errors) == 2


def test_an_unforeseen_error_leaves_a_report_of_what_was_done(tmp_path, monkeypatch):
    path = save(tmp_path, block("Box"))
    other = path.with_name("other.blend")
    other.write_bytes(path.read_bytes())
    decompose_file = command_line.decompose_file

    def fail_for_other(path, *more):
        return 1 / 0 if path == other else decompose_file(path, *more)

    monkeypatch.setattr(command_line, "decompose_file", fail_for_other)
    report = tmp_path / "report.json"
    words = [str(path), str(other), "--hulls", str(tmp_path / "{name}.glb"), *QUICK]
    with pytest.raises(ZeroDivisionError):
        run_wcd(*words, "--report", report)
    told = json.loads(report.read_text(encoding="utf-8"))
    jsonschema.validate(told, SCHEMA)
    assert told["interrupted"]
    assert len(told["inputs"][0]["objects"][0]["hulls"]["hulls"]) == 1


PLACES = {
    "turned": Matrix.LocRotScale((3, -2, 1), Euler((0.4, 0.5, 0.6)), (2, 2, 2)),
    "stretched": Matrix.LocRotScale((0, 1, 5), Euler((0, 0, 1)), (3, 1, 0.5)),
    "mirrored": Matrix.LocRotScale((1, 0, 0), Euler((1, 0, 0)), (-1.5, 1.5, 1.5)),
}


@pytest.mark.parametrize("kind", ["HULL", "BOX", "SPHERE", "CYLINDER", "CAPSULE"])
@pytest.mark.parametrize("place", PLACES)
def test_poses_are_those_of_the_written_hulls(tmp_path, kind, place):
    obj = block("Box")
    obj.matrix_world = PLACES[place]
    path, hulls = save(tmp_path, obj), tmp_path / "h.glb"
    words = ["--hulls", hulls, "--shape", kind.lower(), "--max-hulls", 1, "--quiet"]
    (entry,) = reported(tmp_path, path, *words)["inputs"]
    (told,) = entry["objects"][0]["hulls"]["hulls"]
    assert (told["kind"], told["error_unit"]) == (kind, "RELATIVE")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(hulls))
    (written,) = [o for o in bpy.context.scene.objects if o.type == "MESH"]
    vertices = in_scene(written)
    rotation = Quaternion(told["rotation"])
    assert rotation.magnitude == pytest.approx(1, abs=1e-6)
    local = np.array(
        [rotation.inverted() @ (Vector(v) - Vector(told["position"])) for v in vertices]
    )
    size, reach = told["size"], np.abs(local).max(axis=0)
    if "extents" in size:
        assert 2 * reach == pytest.approx(size["extents"], rel=1e-4)
    else:
        length = size.get("length", 0.0)
        ends = size["radius"] if kind != "CYLINDER" else 0.0
        sides = (size["radius"], size["radius"], length / 2 + ends)
        assert reach == pytest.approx(sides, rel=0.03)
    radius, length = size.get("radius", 0), size.get("length", 0)
    ball = 4 / 3 * math.pi * radius**3
    volumes = {
        "HULL": abs(PLACES[place].determinant()),
        "BOX": math.prod(size.get("extents", ())),
        "SPHERE": ball,
        "CYLINDER": math.pi * radius**2 * length,
        "CAPSULE": math.pi * radius**2 * length + ball,
    }
    assert told["volume"] == pytest.approx(volumes[kind], rel=1e-4)


def test_every_stage_of_progress_has_one_in_the_report():
    sources = [
        path.read_text(encoding="utf-8")
        for folder in ("core", "operators")
        for path in (ROOT / folder).rglob("*.py")
    ]
    named = set(re.findall(r'Progress\(\s*"([^"]+)"', "".join(sources)))
    of_hulls = {"Solid", "Cutting", "Joining", "Measuring", "Shapes"}
    # Not on the command line.
    elsewhere = {"Counting", "Assign", "Merge", "Picture", "Refresh"}
    assert named - of_hulls - elsewhere == set(STAGE_OF)
    assert set(STAGE_OF.values()) <= set(STAGES)


def test_time_is_counted_to_the_stage_that_was_named():
    from weak_convex_decomposition.core.steps.progress import Progress, run

    now = 0.0
    stages = Stages(clock=lambda: now)

    def steps():
        nonlocal now
        now += 1
        yield Progress("Lines of sight", 0.0)
        now += 2
        yield Progress("Cutting", 0.5)
        now += 4
        return "done"

    with stages.during("read"):
        now += 8
    assert run(stages.watched(steps())) == "done"
    seconds = {name: s.seconds for name, s in stages.stages.items() if s.seconds}
    assert seconds == {"prepare": 1, "lines_of_sight": 2, "hulls": 4, "read": 8}


def test_peak_memory_rises_with_what_is_held():
    before = peak_memory()
    held = np.ones(before // 8 + 10_000_000)
    assert peak_memory() >= before + 40_000_000
    assert held.all()
