"""Objects that share a mesh, or have notes of others, on the command line."""

import json

import bpy
import pytest
from hand_made import add_ring, decompose_by_hand
from headless.command import QUICK, run_wcd


@pytest.fixture
def rings(tmp_path):
    """Return a file name and two objects with parts that share a mesh."""
    ring = add_ring("A")
    twin = ring.copy()
    twin.name, twin.location.x = "B", 9
    bpy.context.collection.objects.link(twin)
    for obj in (ring, twin):
        decompose_by_hand(obj, 2)
    return tmp_path / "two.blend", ring, twin


def run_on(path, *options):
    """Save the file, build a hull for each part; return the status and the report."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    report = path.with_name("r.json")
    hulls = path.with_name("{name}.obj")
    words = ["--hulls", hulls, "--pieces=parts", "--report", report, *options]
    status = run_wcd(*words, *QUICK)
    return status, json.loads(report.read_text())["inputs"]


def test_a_linked_copy_keeps_the_shapes_that_were_chosen_for_its_hulls(rings):
    path, _, twin = rings
    twin.wcd_parts[0].hull_shape = "BOX"
    status, (entry,) = run_on(path, path)
    assert status == 0
    kinds = [
        [hull["kind"] for hull in obj["hulls"]["hulls"]] for obj in entry["objects"]
    ]
    assert kinds == [["HULL", "HULL"], ["BOX", "HULL"]]


def test_nothing_is_said_of_parts_that_are_kept(rings, capfd):
    path, _, _ = rings
    capfd.readouterr()
    run_on(path, path)
    titles = [line.partition(":")[0] for line in capfd.readouterr().out.splitlines()]
    assert [title for title in titles if title != "Info"] == [
        f"{path}, A, hulls",
        f"{path}, B, hulls",
    ]


def test_a_property_of_somebody_else_ends_the_work_on_one_object(
    rings, tmp_path, capfd
):
    path, ring, _ = rings
    models = [tmp_path / name for name in ("a.ply", "c.ply")]
    for model in models:
        bpy.ops.wm.ply_export(filepath=str(model))
    ring["wcd"] = "mine"
    capfd.readouterr()
    status, entries = run_on(path, models[0], path, models[1])
    assert status == 1
    said = capfd.readouterr().err.splitlines()
    errors = [line for line in said if "error:" in line]
    assert len(errors) == 1
    assert errors[0].startswith(f"error: {path}, A: ")
    assert [[bool(obj["error"]) for obj in entry["objects"]] for entry in entries] == [
        [False],
        [True, False],
        [False],
    ]
