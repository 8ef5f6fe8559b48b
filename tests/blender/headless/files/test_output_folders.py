"""A folder of meshes belongs to one output, and what is not ours stays."""

import json

import pytest
from headless.command import content
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.headless.files.output_folders import (
    MANIFEST,
    replacing_with_folder,
)


def write(path, **meshes):
    """Write a file with its folder of meshes."""
    with replacing_with_folder(path) as (unfinished, folder):
        unfinished.write_text(f"<robot meshes='{len(meshes)}'/>")
        for name, text in meshes.items():
            (folder / f"{name}.obj").write_text(f"{text}\n")


def test_two_simulator_files_have_folders_of_their_own(tmp_path, model, run):
    assert run(model, "--hulls", tmp_path / "z.urdf") == 0
    robot = content(tmp_path)
    assert run(model, "--hulls", tmp_path / "z.xml", "--max-hulls=2") == 0
    both = content(tmp_path)
    assert robot.items() <= both.items()
    for name in ("z_urdf", "z_xml"):
        manifest = json.loads(both[f"{name}/{MANIFEST}"])
        assert manifest["belongs_to"] == name.replace("_", ".")
        meshes = {f for f in both if f.startswith(f"{name}/")} - {f"{name}/{MANIFEST}"}
        assert {f"{name}/{each}" for each in manifest["files"]} == meshes
        for mesh, entry in manifest["files"].items():
            assert entry["bytes"] == len(both[f"{name}/{mesh}"])
            assert f"{name}/{mesh}" in both[name.replace("_", ".")].decode()


def test_names_with_dots_and_blanks(tmp_path, model, run):
    assert run(model, "--hulls", tmp_path / "a. b.c.URDF") == 0
    (name,) = {name.partition("/")[0] for name in content(tmp_path)} - {
        "in",
        "a. b.c.URDF",
    }
    assert name == "a. b.c_urdf"
    assert f'"{name}/' in (tmp_path / "a. b.c.URDF").read_text()
    assert (
        run(model, "--report", tmp_path / "report", "--hulls", tmp_path / "x.y.xml")
        == 0
    )
    assert json.loads((tmp_path / "report").read_text())["inputs"]
    assert not list(tmp_path.glob(".wcd*"))


def test_fewer_meshes_replace_more_and_notes_stay(tmp_path):
    path = tmp_path / "z.urdf"
    write(path, a="a", b="b", c="c")
    (tmp_path / "z_urdf" / "notes.txt").write_text("mine")
    (tmp_path / "z_urdf" / "more").mkdir()
    (tmp_path / "z_urdf" / "more" / "a.obj").write_text("mine, too")
    write(path, a="new")
    found = content(tmp_path)
    del found[f"z_urdf/{MANIFEST}"]
    assert found == {
        "z.urdf": b"<robot meshes='1'/>",
        "z_urdf/a.obj": b"new\n",
        "z_urdf/more/a.obj": b"mine, too",
        "z_urdf/notes.txt": b"mine",
    }


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda f: (f / "001.obj").write_text("mine"), "001.obj was changed since"),
        (lambda f: (f / "mine.OBJ").write_text("mine"), "mine.OBJ was not written by"),
        (lambda f: (f / MANIFEST).unlink(), "z_urdf was not written by us"),
        (lambda f: (f / MANIFEST).write_text("{}"), "z_urdf was not written by us"),
        (lambda f: (f / MANIFEST).write_text("[1"), "z_urdf was not written by us"),
        (lambda f: f.rename(f.with_name("y_urdf")), "y_urdf belongs to z.urdf"),
    ],
)
def test_what_is_the_users_is_refused_beforehand(
    tmp_path, model, capfd, change, sentence, run
):
    write(tmp_path / "z.urdf", **{"001": "a", "002": "b"})
    change(tmp_path / "z_urdf")
    name = "y" if (tmp_path / "y_urdf").exists() else "z"
    before = content(tmp_path)
    capfd.readouterr()
    assert run(model, "--hulls", tmp_path / f"{name}.urdf") == 2
    error = capfd.readouterr().err
    assert sentence in error
    assert error.count("\n") == 2
    assert content(tmp_path) == before


def test_a_folder_of_the_users_is_refused(tmp_path, model, capfd, run):
    (tmp_path / "z_xml").mkdir()
    (tmp_path / "z_xml" / "001.obj").write_text("mine")
    assert run(model, "--hulls", tmp_path / "z.xml") == 2
    assert "was not written by us" in capfd.readouterr().err
    (tmp_path / "z_xml" / "001.obj").unlink()
    (tmp_path / "z_xml").rmdir()
    (tmp_path / "z_xml").write_text("mine")
    assert run(model, "--hulls", tmp_path / "z.xml") == 2
    assert "z_xml is a file" in capfd.readouterr().err
    (tmp_path / "z_xml").unlink()
    (tmp_path / "z_xml").mkdir()  # an empty folder is nobody's
    assert run(model, "--hulls", tmp_path / "z.xml") == 0


def test_what_appears_meanwhile_stays(tmp_path):
    path = tmp_path / "z.urdf"
    write(path, a="a")
    before = content(tmp_path)

    def write_meanwhile():
        with replacing_with_folder(path) as (unfinished, folder):
            unfinished.write_text("<robot/>")
            (folder / "a.obj").write_text("new\n")
            (tmp_path / "z_urdf" / "a.obj").write_text("mine")

    with pytest.raises(DecompositionError, match="changed since"):
        write_meanwhile()
    assert content(tmp_path) == {**before, "z_urdf/a.obj": b"mine"}


def test_a_failure_leaves_file_and_folder(tmp_path):
    path = tmp_path / "z.urdf"
    write(path, a="a", b="b")
    before = content(tmp_path)

    def write_half(text, mesh):
        with replacing_with_folder(path) as (unfinished, folder):
            unfinished.write_text(text)
            (folder / "a.obj").write_text(mesh)

    for text, mesh in (("<robot", "whole\n"), ("<robot/>", "a line without end")):
        with pytest.raises(OSError, match="in part only"):
            write_half(text, mesh)
        assert content(tmp_path) == before


def test_outputs_that_collide_are_refused(tmp_path, model, capfd, run):
    (tmp_path / "link.json").symlink_to(tmp_path / "r.glb")
    cases = [
        (("--output={}/a.glb", "--hulls={}/A.GLB"), "differ in upper and lower case"),
        (
            ("--output={}/\u00e9.glb", "--hulls={}/e\u0301.glb"),
            "how accents are stored",
        ),
        (("--output={}/w.obj", "--report={}/w.mtl"), "would be written twice"),
        (("--output={}/r.glb", "--report={}/link.json"), "would be written twice"),
        (("--hulls={}/z.xml", "--report={}/z_xml"), "would be written twice"),
        (("--hulls={}/z.xml", "--output={}/Z_xml/001.obj"), "is in {}/z_xml, which"),
        (("--hulls={}/z.xml", "--report={}/z.xml/r.json"), "is in {}/z.xml, which"),
        (("--hulls={}/in/ring.ply/z.xml",), "ring.ply is a file, not a folder"),
        (("--output={}/in/../in/ring.ply",), "is an input, too"),
        (("--output={}/in/RING.ply",), "differ in upper and lower case"),
    ]
    before = content(tmp_path)
    for options, sentence in cases:
        capfd.readouterr()
        assert run(model, *(o.format(tmp_path) for o in options)) == 2, options
        assert sentence.format(tmp_path) in capfd.readouterr().err, options
    assert content(tmp_path) == before


def test_an_input_in_a_folder_that_is_replaced(tmp_path, model, capfd, run):
    write(tmp_path / "z.urdf", a="v 0 0 0")
    words = [tmp_path / "z_urdf" / "a.obj", "--hulls", tmp_path / "z.urdf"]
    assert run(*words) == 2
    assert "which is written as a whole" in capfd.readouterr().err


def test_meshes_of_an_earlier_output_are_not_replaced(tmp_path, model, capfd, run):
    write(tmp_path / "z.urdf", **{"001": "v 0 0 0"})
    folder = tmp_path / "z_urdf"
    (tmp_path / "link.obj").symlink_to(folder / "001.obj")
    before = content(tmp_path)
    for option, place in (
        ("--hulls", folder / "001.obj"),
        ("--hulls", tmp_path / "link.obj"),
        ("--output", folder / "new.obj"),
        ("--report", folder / MANIFEST),
        ("--hulls", folder / "{name}.obj"),
    ):
        capfd.readouterr()
        assert run(model, option, place) == 2, place
        assert "z_urdf, which holds the meshes of z.urdf;" in capfd.readouterr().err
    assert content(tmp_path) == before
    assert run(model, "--hulls", folder / "more" / "001.obj") == 0
    (folder / MANIFEST).write_text("{}")
    assert run(model, "--hulls", folder / "001.obj") == 2
    assert "which holds the meshes of another output;" in capfd.readouterr().err
