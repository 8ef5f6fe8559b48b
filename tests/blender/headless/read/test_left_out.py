"""What is left out is said: curves, objects without faces, instances of no size."""

import json

import bpy
import pytest
from headless.command import run_wcd
from headless.instancing import (
    add,
    collection_with_rock,
    instance_of,
    mesh_of,
    rock,
    saved,
)
from headless.loading import load
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.bridge.read.reading_notes import reading_notes
from weak_convex_decomposition.operators.headless.read.load import load_file

QUICK = ["--samples=60", "--parts=1", "--max-hulls=1", "--quiet"]


def add_curve(name, **settings):
    """Add a circle with settings of its curve."""
    bpy.ops.curve.primitive_bezier_circle_add()
    obj = bpy.context.active_object
    obj.name = name
    for setting, value in settings.items():
        setattr(obj.data, setting, value)
    return obj


def test_curves_and_texts_that_are_seen_are_counted(tmp_path, capfd):
    bpy.ops.mesh.primitive_cube_add()
    path = add_curve("Path")  # without faces
    path.data.extrude = 0.0
    section = add_curve("Section", dimensions="2D", fill_mode="BOTH")
    add_curve("Hose", bevel_mode="OBJECT", bevel_object=section)
    bpy.ops.object.text_add()
    bpy.context.active_object.hide_viewport = True
    bpy.ops.object.metaball_add()
    model, report = saved(tmp_path / "a.blend"), tmp_path / "r.json"
    capfd.readouterr()
    words = [model, "--output", tmp_path / "o.obj", "--report", report, *QUICK]
    assert run_wcd(*words) == 0
    note = (
        "3 curves, texts or metaballs get neither parts nor hulls; convert them to"
        " meshes first (Object > Convert > Mesh)."
    )
    assert capfd.readouterr().err.endswith(f"\nwarning: {model}: {note}\n")
    assert json.loads(report.read_text())["inputs"][0]["notes"] == [note]


SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
SHORT = [(0, 1, 2), (0, 2, 3), (0, 1), (2,)]


def rows(table, first=""):
    """Return the text of rows of numbers; the word comes first in each."""
    return "".join(f"{first}{' '.join(map(str, row))}\n" for row in table)


def in_formats(faces):
    """Return the text of a file with these faces, by its name."""
    lists = rows(SQUARE) + rows((len(face), *face) for face in faces)
    ply = "ply\nformat ascii 1.0\nelement vertex 4\n"
    ply += rows("xyz", "property float ") + f"element face {len(faces)}\n"
    ply += "property list uchar int vertex_indices\nend_header\n"
    return {
        "a.obj": rows(SQUARE, "v ")
        + rows(([corner + 1 for corner in face] for face in faces), "f "),
        "a.off": f"OFF\n4 {len(faces)} 0\n{lists}",
        "a.ply": ply + lists,
    }


@pytest.mark.parametrize("ending", ["obj", "off", "ply"])
def test_faces_that_are_left_out_are_counted(tmp_path, ending):
    cases = (SHORT[:2], None), (SHORT, "2 of 4 faces"), (SHORT[:2] * 2, "2 of 4 faces")
    path = tmp_path / f"a.{ending}"
    for faces, note in cases:
        path.write_text(in_formats(faces)[path.name])
        about = load_file(path, None, with_modifiers=False).about
        assert (not about) if note is None else about[0].startswith(note)


def test_a_file_of_nothing_else_says_what_to_do(tmp_path):
    add_curve("Ring", extrude=1.0)
    with pytest.raises(DecompositionError, match=r"clouds\. A curve, text"):
        load(saved(tmp_path / "a.blend"))
    bpy.data.objects["Ring"].data.extrude = 0.0
    with pytest.raises(DecompositionError, match=r"clouds\.$"):
        load(saved(tmp_path / "a.blend"))


def test_files_of_meshes_have_no_note(tmp_path):
    bpy.ops.mesh.primitive_cube_add()
    assert load_file(saved(tmp_path / "a.blend"), None, False).about == ()


@pytest.mark.parametrize("goal", [["--hulls", "h.glb"], ["--output", "o.blend"]])
def test_objects_without_faces_are_named(tmp_path, capfd, goal):
    bpy.ops.mesh.primitive_cube_add()
    add("Wire", mesh_of([(0, 0, 0), (1, 0, 0)], [], "Wire"))
    bpy.data.meshes["Wire"].edges.add(1)
    bpy.data.meshes["Wire"].edges[0].vertices = (0, 1)
    model = saved(tmp_path / "a.blend")
    capfd.readouterr()
    assert run_wcd(model, goal[0], tmp_path / goal[1], *QUICK) == 0
    assert f"warning: {model}, Wire: It has no faces and" in capfd.readouterr().err


@pytest.mark.parametrize("ending", ["glb", "obj", "usd", "fbx", "ply", "blend"])
def test_instances_of_no_size_are_not_written(tmp_path, ending):
    rocks = collection_with_rock()
    instance_of(rocks, "Spot")
    instance_of(rocks, "Flat", (0, 9, 0)).scale.x = 0.0
    output = tmp_path / f"o.{ending}"
    model = saved(tmp_path / "a.blend")
    assert run_wcd(model, "--output", output, *QUICK) == 0
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    (rock,) = load(output)
    assert len(rock.data.polygons) == 4
    if ending == "blend":
        bpy.ops.wm.open_mainfile(filepath=str(output))
        assert not any(obj.instance_collection for obj in bpy.data.objects)


@pytest.mark.parametrize("ending", ["usda", "usdc"])
def test_layers_of_layers_that_are_missing_or_damaged(tmp_path, ending):
    from pxr import Sdf

    add("Rock", rock())
    bpy.ops.wm.usd_export(filepath=str(tmp_path / "rock.usdc"))
    inner, model = tmp_path / "in" / "ner.usda", tmp_path / f"model.{ending}"
    inner.parent.mkdir()
    layers = "#usda 1.0\n(subLayers = [@../rock.usdc@, @./no.usdc@])\n"
    inner.write_text(layers)
    outer = Sdf.Layer.CreateAnonymous(".usda")
    outer.subLayerPaths.append("in/ner.usda")
    outer.Export(str(model))
    loaded = load_file(model, None, with_modifiers=False)
    assert {inner, tmp_path / "rock.usdc"} <= {*loaded.refers_to}
    (note,) = loaded.about
    assert note.startswith("What is in layers that are missing was left out")
    assert note.endswith(": no.usdc.")
    (tmp_path / "in" / "no.usdc").write_bytes(b"PXR-USDC" + bytes(99))
    with pytest.raises(DecompositionError, match="a layer of USD that is damaged"):
        load_file(model, None, with_modifiers=False)


@pytest.mark.parametrize("has_rock", [True, False])
def test_layers_that_are_missing_are_named(tmp_path, has_rock, capfd):
    add("Rock", rock())
    bpy.ops.wm.usd_export(filepath=str(tmp_path / "rock.usdc"))
    layers = ["rock.usdc", "no.usda"] if has_rock else ["no.usda"]
    prims = (
        f'def "P{number}" (references = @./{layer}@</root>) {{}}\n'
        for number, layer in enumerate(layers)
    )
    model, report = tmp_path / "a.usda", tmp_path / "r.json"
    model.write_text(f"#usda 1.0\n{''.join(prims)}")
    capfd.readouterr()
    status = run_wcd(model, "--report", report, *QUICK)
    assert "_ReportErrors" not in capfd.readouterr().err  # USD's own words
    (entry,) = json.loads(report.read_text())["inputs"]
    note = (
        "What is in layers that are missing was left out; put them where the file"
        " refers to them: no.usda."
    )
    if has_rock:
        assert (status, entry["notes"]) == (0, [note])
    else:
        sentence = f"{model} has no meshes or point clouds. {note}"
        assert (status, entry["errors"]) == (1, [sentence])


@pytest.mark.parametrize(
    ("place", "size", "note"),
    [(4.5e6, 2, "to steps of 0.5;"), (4.5e6, 2e3, ""), (1e3, 2, ""), (0, 1e-9, "")],
)
def test_digits_that_single_precision_lacks(tmp_path, place, size, note):
    """As of scans in coordinates of a country's survey."""
    points = [(place, size * x, size * y) for x in range(5) for y in range(5)]
    (tmp_path / "a.xyz").write_text(rows(points))
    (tmp_path / "b.obj").write_text(rows(points, "v ") + "f 1 2 7 6\n")
    for name in ("a.xyz", "b.obj"):
        (obj,) = load(tmp_path / name)
        obj.location.x = 4.5e6  # this rounds no vertices
        notes = reading_notes(obj)
        assert note in "".join(notes)
        assert len(notes) == bool(note)


@pytest.mark.parametrize("row", ["F 1 2 3", "\tF 3 2 1", "V 0 0 1"])
def test_lines_of_obj_in_capitals(tmp_path, row):
    model = tmp_path / "a.obj"
    model.write_text(f"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n{row}\n")
    with pytest.raises(DecompositionError, match="has words in capital letters"):
        load(model)
