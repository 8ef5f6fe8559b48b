"""Standard streams as files, places where nothing can be written, missing libraries."""

import io
import json
import os
import re
import subprocess
import sys

import bpy
import pytest
from checkout import PACKAGE, ROOT
from headless.command import QUICK, content, run_wcd, start
from weak_convex_decomposition.operators.headless.request.options import parse

NOBODY = 65534
WITHOUT_SCIPY = """
import sys
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] == {library!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Missing())
"""


@pytest.fixture
def model(tmp_path):
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.wm.ply_export(filepath=str(tmp_path / "a.ply"))
    return tmp_path / "a.ply"


def run(*arguments):
    return run_wcd(*arguments, *QUICK)


def test_the_report_on_standard_output_is_alone_there(tmp_path, model):
    model = model.rename(tmp_path / "ä\udcff.ply")
    process = start(model, "--report=-", *QUICK, environment={"LC_ALL": "C"})
    out, err = process.communicate(timeout=100)
    assert process.returncode == 0
    assert json.loads(out)["inputs"][0]["input"] == str(model)
    assert ": 2 parts, psi" in err
    assert sorted(content(tmp_path)) == [model.name]


def test_a_path_that_is_not_unicode_in_a_report(tmp_path, model):
    model = model.rename(tmp_path / "a\udcff.ply")
    assert run(model, "--report", tmp_path / "r.json", "--quiet") == 0
    report = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))
    assert report["inputs"][0]["input"] == str(model)


def listed(monkeypatch, data):
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))


def test_a_list_of_inputs(tmp_path, model, monkeypatch, capfd):
    listed(monkeypatch, b"\xef\xbb\xbfb c.ply\r\n\n" + os.fsencode("ä\udcff.ply"))
    words = ["a.ply", "-", "d.ply", "--output", f"{tmp_path}/{{name}}.glb"]
    request = parse(words, "wcd")
    names = ["a.ply", "b c.ply", "ä\udcff.ply", "d.ply"]
    assert [str(path) for path in request.inputs] == names
    assert request.targets[2].output == tmp_path / "ä\udcff.glb"
    for data, given, sentence in (
        (b"\n \n", ["-"], "standard input has no line"),
        (b"a.ply\0b.ply\0", ["-"], "write one path a line, as `find -print` does"),
        (b"a.ply", ["-", "-"], "INPUT is - twice"),
    ):
        listed(monkeypatch, data)
        capfd.readouterr()
        assert run(*given) == 2
        assert sentence in capfd.readouterr().err
    monkeypatch.setattr(sys, "stdin", None)
    assert run("-") == 2
    assert "standard input is closed" in capfd.readouterr().err


def test_a_list_through_a_pipe(tmp_path, model):
    words = ["-", "--output", tmp_path / "{name}.glb", *QUICK, "--quiet"]
    process = start(*words, stdin=subprocess.PIPE)
    _, err = process.communicate(f"{model}\n{tmp_path}/none.ply\n", timeout=100)
    assert process.returncode == 1
    assert err.endswith(f"error: {tmp_path}/none.ply does not exist.\n")
    assert (tmp_path / "a.glb").exists()


def test_places_where_nothing_can_be_written(tmp_path, model, capfd):
    locked = tmp_path / "locked"
    locked.mkdir()
    (locked / "old.glb").write_text("old")
    (tmp_path / "old.glb").write_text("old")
    (tmp_path / "old.glb").chmod(0o444)
    (tmp_path / f"link.{'glb'}").symlink_to(locked / "a.glb")
    locked.chmod(0o555)
    cases = [
        (locked / "a.glb", "is read-only"),
        (locked / "old.glb", "is read-only"),
        (locked / "x" / "a.glb", "is read-only"),
        (tmp_path / "link.glb", "is read-only"),
        (tmp_path / "old.glb", "is read-only"),
        (tmp_path / f"{'a' * 300}.glb", "(File name too long)"),
        (model / "x.glb", "is a file, not a folder"),
    ]
    before = content(tmp_path)
    for path, sentence in cases:
        capfd.readouterr()
        with as_somebody(tmp_path):
            assert run(model, "--output", path, "--quiet") == 2, path
        error = capfd.readouterr().err
        assert sentence in error, path
        assert error.count("\n") == 2, path
    assert content(tmp_path) == before


@pytest.mark.parametrize("ending", ["glb", "XML", "png", "stl"])
def test_a_report_with_the_ending_of_another_format(tmp_path, model, ending, capfd):
    before = content(tmp_path)
    assert run(model, "--report", tmp_path / f"r.{ending}") == 2
    sentence = f"name a file that ends in .json, not in .{ending.lower()}."
    assert sentence in capfd.readouterr().err
    assert content(tmp_path) == before


@pytest.mark.parametrize("ending", ["urdf", "xml"])
@pytest.mark.parametrize("name", ["a\udcff", "ctl\x01", "a\uffff"])
def test_a_name_that_xml_cannot_hold_is_refused_beforehand(
    tmp_path, model, ending, name, capfd
):
    before = content(tmp_path)
    assert run(model, "--hulls", tmp_path / f"{name}.{ending}") == 2
    assert "has a name with control characters, or" in capfd.readouterr().err
    assert content(tmp_path) == before


class as_somebody:
    """Run a block without the rights of root, who may write anywhere."""

    def __init__(self, folder):
        self.is_root = os.geteuid() == 0
        for each in (folder, *folder.parents):
            if self.is_root and each.owner() == "root" and "pytest" in str(each):
                each.chmod(0o755)

    def __enter__(self):
        if self.is_root:
            os.seteuid(NOBODY)

    def __exit__(self, *error):
        if self.is_root:
            os.seteuid(0)


def python(code, *arguments):
    """Run code that leaves Blender's exit out, which may crash; return what it said."""
    environment = {k: v for k, v in os.environ.items() if k != "OCIO"}
    support = str(ROOT / "tests" / "support")
    return subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)],
        env=environment | {"PYTHONPATH": support},
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )


@pytest.mark.parametrize("library", ["scipy", "sklearn", "threadpoolctl"])
def test_a_missing_library_is_a_sentence(tmp_path, model, library):
    code = f"""{WITHOUT_SCIPY.format(library=library)}
import checkout
from {PACKAGE}.__main__ import wcd
wcd()
"""
    done = python(code, model, "--output", tmp_path / "b.glb")
    (line,) = done.stderr.splitlines()
    assert (done.returncode, done.stdout) == (2, "")
    assert re.match(f"error: SciPy.*No module named '{library}.*pip install", line)
    assert not (tmp_path / "b.glb").exists()


@pytest.mark.parametrize("library", ["scipy", "sklearn", "threadpoolctl"])
def test_a_missing_library_in_a_script(library):
    code = f"""{WITHOUT_SCIPY.format(library=library)}
import checkout, os
from {PACKAGE} import DecompositionError, build_hulls, decompose, measure
faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
for function in (decompose, measure, build_hulls):
    try:
        function([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], faces)
    except DecompositionError as error:
        print(error)
    else:
        print("no error")
sys.stdout.flush()
os._exit(0)
"""
    done = python(code)
    assert done.stderr == ""
    lines = done.stdout.splitlines()
    assert len(lines) == 3
    said = [line for line in lines if line != "no error"]  # not all need all
    assert said
    for line in said:
        assert re.match(f"SciPy.*No module named '{library}.*pip install", line)
