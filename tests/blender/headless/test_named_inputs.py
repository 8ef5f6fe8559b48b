"""How the lines of a run name its inputs."""

import pytest
from headless.command import run_wcd

CORNERS = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
FACES = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


@pytest.fixture
def told(tmp_path, monkeypatch, capfd):
    """Return a function that runs the program; it returns its results and errors."""
    monkeypatch.chdir(tmp_path)

    def run(*words):
        capfd.readouterr()
        run_wcd(*words)
        return [stream.splitlines() for stream in capfd.readouterr()]

    return run


def test_inputs_of_one_name_are_told_apart_by_their_folders(tmp_path, told):
    contents = {"a": CORNERS + FACES, "b": "f 1 2 9\n", "c": CORNERS, "d": ""}
    for folder, content in contents.items():
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "chair.obj").write_text(content)
    paths = [f"{folder}/chair.obj" for folder in contents]
    results, errors = told(*paths, "--quiet")
    assert [line.partition("chair")[0] for line in errors] == [
        f"error: {folder}/" for folder in "bcd"
    ]
    results, _ = told(paths[0], "--hulls", "h.glb")
    assert [line for line in results if line.startswith("a/chair.obj, chair, hulls: ")]


def test_line_breaks_and_colors_in_names_are_spelled_out(tmp_path, told):
    (tmp_path / "a\n\x1b[31m.obj").write_text(CORNERS + FACES)
    results, errors = told("a\n\x1b[31m.obj", "no\r.obj")
    assert results[-1].startswith(r"a\n\x1b[31m.obj, ")
    assert r"error: no\r.obj does not exist." in errors
    _, (error, _) = told("b\n.obj", "--output=b\n.obj")
    assert error.startswith(r"error: b\n.obj is an input, too")
