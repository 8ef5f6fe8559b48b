"""Notes on what was read of an object, where objects share hulls."""

import json

import bpy
import pytest
from headless.command import run_wcd

READ = "The mesh was read without its modifiers (Finer)."


def add_twins(with_modifier):
    """Add three objects of one mesh; those with these names have a modifier."""
    bpy.ops.mesh.primitive_cube_add()
    first = bpy.context.active_object
    first.name = "A"
    for x, name in enumerate("BC", start=1):
        twin = first.copy()
        twin.name, twin.location.x = name, 3 * x
        bpy.context.collection.objects.link(twin)
    for name in with_modifier:
        bpy.data.objects[name].modifiers.new("Finer", "SUBSURF")


@pytest.mark.parametrize("with_modifier", ["A", "B", "BC", ""])
def test_each_object_has_notes_of_its_own(tmp_path, capfd, with_modifier):
    add_twins(with_modifier)
    model, report = tmp_path / "model.blend", tmp_path / "r.json"
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    capfd.readouterr()
    words = [f"--hulls={tmp_path / 'a.glb'}", f"--report={report}", "--quiet"]
    assert run_wcd(model, *words) == 0
    (entry,) = json.loads(report.read_text())["inputs"]
    noted = {obj["name"]: READ in obj["hulls"]["notes"] for obj in entry["objects"]}
    assert noted == {name: name in with_modifier for name in "ABC"}
    err = capfd.readouterr().err
    said = {name: f"{name}, hulls: {READ}" in err for name in "ABC"}
    assert said == noted


def test_notes_on_hulls_are_on_all_that_have_them(tmp_path):
    add_twins("B")
    model, report = tmp_path / "model.blend", tmp_path / "r.json"
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    words = [f"--hulls={tmp_path / 'a.glb'}", f"--report={report}", "--quiet"]
    assert run_wcd(model, *words, "--margin=-0.9") == 0
    (entry,) = json.loads(report.read_text())["inputs"]
    of_hulls = [
        [note for note in obj["hulls"]["notes"] if "modifiers" not in note]
        for obj in entry["objects"]
    ]
    assert len(of_hulls[0]) == 1
    assert of_hulls == of_hulls[:1] * 3
