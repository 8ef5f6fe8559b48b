"""Names of hulls: those of the report are in the file, and tell their bodies."""

import json
import re
import xml.etree.ElementTree as ET

import bpy
import pytest
from headless.command import run_wcd

# Names that some formats change, and one that simulators use themselves.
OBJECTS = ["A b", "A_b", "A/b", "world", "  ", "1é"]
# What has the name of a hull or of a visible mesh, in .urdf and .xml.
SHAPES = ("geom", "collision", "visual")


def run(tmp_path, *words):
    """Run on cubes that have these names; return the names of hulls in the report."""
    for x, name in enumerate(OBJECTS):
        bpy.ops.mesh.primitive_cube_add(location=(3 * x, 0, 0))
        bpy.context.active_object.name = name
    model, report = tmp_path / "model.blend", tmp_path / "r.json"
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    words = [*words, "--samples=60", "--parts=1", "--quiet", f"--report={report}"]
    assert run_wcd(model, *words) == 0
    (entry,) = json.loads(report.read_text(encoding="utf-8"))["inputs"]
    return [hull["name"] for obj in entry["objects"] for hull in obj["hulls"]["hulls"]]


def names_in(path):
    """Return the names of the hulls in a file."""
    if path.suffix == ".urdf":
        return [e.get("name") for e in ET.parse(path).getroot().iter("collision")]
    if path.suffix == ".xml":
        geoms = ET.parse(path).getroot().iter("geom")
        return [e.get("name") for e in geoms if e.get("class") == "collision"]
    if path.suffix == ".glb":
        data = path.read_bytes()
        text = data[20 : 20 + int.from_bytes(data[12:16], "little")]
        return [node["name"] for node in json.loads(text)["nodes"]]
    pattern = {".obj": r"^o (.*)$", ".usd": r'def Mesh "(.*)"'}[path.suffix]
    return re.findall(pattern, path.read_text(encoding="utf-8"), re.MULTILINE)


@pytest.mark.parametrize("ending", ["obj", "usd", "urdf", "xml", "glb"])
@pytest.mark.parametrize("bodies", ["one", "each"])
@pytest.mark.parametrize("naming", ["plain", "unreal"])
def test_the_report_has_the_names_of_the_file(tmp_path, ending, bodies, naming):
    path = tmp_path / f"hulls.{ending}"
    options = [f"--hulls={path}", f"--bodies={bodies}", f"--naming={naming}"]
    reported = run(tmp_path, *options)
    assert len(set(reported)) == len(OBJECTS)
    assert sorted(names_in(path)) == sorted(reported)


def test_other_files_have_plain_names(tmp_path):
    for words in (
        [f"--hulls={tmp_path / 'hulls.stl'}"],
        [f"--output={tmp_path / 'model.usd'}", "--with-hulls"],
    ):
        assert set(run(tmp_path, *words)) == {f"{name} hull 01" for name in OBJECTS}
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)


@pytest.mark.parametrize("ending", ["urdf", "xml"])
@pytest.mark.parametrize("bodies", ["one", "each"])
def test_hulls_have_the_names_of_their_bodies(tmp_path, ending, bodies):
    path = tmp_path / f"hulls.{ending}"
    run(tmp_path, f"--hulls={path}", f"--bodies={bodies}")
    found = {}
    for body in ET.parse(path).getroot().iter("link" if ending == "urdf" else "body"):
        names = [e.get("name") for e in body.iter() if e.tag in SHAPES]
        if names:
            found[body.get("name")] = sorted(names)
    world = "world_2" if bodies == "each" else "world"
    titles = ["unnamed", "A b", "A_b_2", "A_b", world, "1é"]
    expected = {title: [f"{title} hull 01", f"{title} surface"] for title in titles}
    if bodies == "each":
        assert found == expected
    else:
        (names,) = found.values()
        assert names == sorted(name for two in expected.values() for name in two)


def test_a_template_without_the_name_of_the_object_is_the_culprit(tmp_path, capsys):
    for x in (0, 3):
        bpy.ops.mesh.primitive_cube_add(location=(x, 0, 0))
    model = tmp_path / "model.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    words = [f"--hulls={tmp_path / 'a.glb'}", "--naming=template", "--template=x{n}"]
    assert run_wcd(model, *words, "--quiet") == 1
    sentence = "Another object has a hull x1 already; put {name} into Template, or"
    assert sentence in capsys.readouterr().err
