"""Nothing is lost on a full disk, and a half file is noticed."""

import gc
import json
import os
import shutil
from functools import partial

import bpy
import pytest
from headless.command import content
from headless.full_disk import file_limit, full_disk
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.headless.files.replacing import replacing
from weak_convex_decomposition.operators.headless.files.swap import swap
from weak_convex_decomposition.operators.headless.files.whole import check_whole
from weak_convex_decomposition.operators.headless.formats import (
    HULL_ENDINGS,
    MODEL_ENDINGS,
)
from weak_convex_decomposition.operators.headless.write import picture

OPTIONS = {"output": MODEL_ENDINGS, "hulls": HULL_ENDINGS, "report": (".json",)}
# Blender's exporter of .glb leaves a file open that it cannot write.
pytestmark = pytest.mark.filterwarnings(
    "ignore::pytest.PytestUnraisableExceptionWarning", "ignore::ResourceWarning"
)
CASES = [(option, ending) for option, all_ in OPTIONS.items() for ending in all_]


@pytest.mark.parametrize(("option", "ending"), CASES)
def test_a_full_disk_leaves_what_was_there(tmp_path, model, option, ending, capfd, run):
    disk = tmp_path / "disk"
    disk.mkdir()
    path = disk / f"a{ending}"
    with full_disk(disk) as leave_free:
        assert run(model, f"--{option}", path) == 0
        before = content(disk)
        largest = max(map(len, before.values()))
        capfd.readouterr()
        with leave_free(largest // 2) as cause:
            (status, error) = run(model, f"--{option}", path), capfd.readouterr().err
        assert status == 1
        assert f"{path} cannot be" in error
        assert f"({cause})." in error
        assert error.count("error: ") == 1
        assert "Traceback" not in error
        assert content(disk) == before
        assert run(model, f"--{option}", path) == 0
        assert content(disk).keys() == before.keys()
    gc.collect()  # while the file that is left open is no error


def test_a_full_disk_leaves_the_picture(tmp_path, suzanne, monkeypatch):
    monkeypatch.setattr(picture, "SIZE", 128)
    disk = tmp_path / "disk"
    disk.mkdir()
    path = disk / "a.png"
    save = partial(picture.save_picture, path, [suzanne], "CYCLES")
    with full_disk(disk) as leave_free:
        save()
        before = content(disk)
        with (
            leave_free(path.stat().st_size // 2) as cause,
            pytest.raises(DecompositionError, match=cause),
        ):
            save()
        assert content(disk) == before


def test_a_limit_at_the_end_of_a_line_is_noticed(tmp_path, model, capfd, run):
    path = tmp_path / "a.obj"
    assert run(model, "--output", path) == 0
    written = path.read_bytes()
    end = written.index(b"\nf ", len(written) * 3 // 4) + 1
    capfd.readouterr()
    with file_limit(end):
        assert run(model, "--output", path) == 1
    assert "(File too large)" in capfd.readouterr().err
    assert path.read_bytes() == written


def test_every_cut_is_noticed(tmp_path, model, run):
    for option, ending in CASES:
        run(model, f"--{option}", tmp_path / f"{option}{ending}")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "plain.blend"), compress=False)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "small.blend"), compress=True)
    bpy.ops.export_scene.fbx(filepath=str(tmp_path / "a.fbx"))
    image = bpy.data.images.new("Small", 64, 64)
    image.save(filepath=str(tmp_path / "a.png"))
    files = [f for f in tmp_path.rglob("*") if f.is_file() and f.parent.name != "in"]
    assert {f.suffix for f in files} >= {".mtl", ".fbx", ".png", *(e for _, e in CASES)}
    for file in files:
        whole = file.read_bytes()
        check_whole(file)
        assert file.read_bytes() == whole
        for size in (0, 1, 10, len(whole) // 3, len(whole.rstrip(b"\n")) - 1):
            cut = tmp_path / f"cut{file.suffix}"
            cut.write_bytes(whole[:size].rstrip(b"\n"))
            with pytest.raises(OSError, match="in part only"):
                check_whole(cut)


def test_materials_are_replaced_with_their_model_alone(tmp_path, model, capfd, run):
    path, materials = tmp_path / "w.obj", tmp_path / "w.mtl"
    materials.write_text("newmtl mine\n")
    capfd.readouterr()
    assert run(model, "--output", path) == 2
    assert f"{materials} does not belong to w.obj" in capfd.readouterr().err
    assert not path.exists()
    path.write_text("mtllib other.mtl\nv 0 0 0\n")
    assert run(model, "--output", path) == 2
    assert materials.read_text() == "newmtl mine\n"
    path.write_text("# a model\nmtllib w.mtl\r\nv 0 0 0\n")
    assert run(model, "--output", path) == 0
    assert "newmtl Part" in materials.read_text()


def test_several_moves_are_taken_back_together(tmp_path):
    new, goals = tmp_path / "new", tmp_path / "goals"
    for folder in (new, new / "meshes", goals, goals / "meshes"):
        folder.mkdir()
        for name in ("a", "b"):
            (folder / name).write_text(str(folder))
    (goals / "meshes" / "mine").write_text("mine")
    (goals / "b").unlink()
    before = content(goals)
    owned = frozenset({"a", "b"})
    moves = [(new / name, goals / name) for name in ("meshes", "a", "b")]
    (goals / "b").mkdir()  # a file does not replace a folder
    (goals / "b" / "mine").write_text("mine")
    with pytest.raises(OSError, match="b"):
        swap(moves, owned)
    shutil.rmtree(goals / "b")
    assert content(goals) == before
    assert sorted(os.listdir(goals)) == ["a", "meshes"]


def test_the_rights_of_a_file_stay(tmp_path):
    path = tmp_path / "a.json"
    path.write_text("{}")
    path.chmod(0o640)
    with replacing(path) as unfinished:
        unfinished.write_text("[]")
    assert (path.read_text(), path.stat().st_mode & 0o777) == ("[]", 0o640)


def test_missing_folders_are_made_and_removed_again(tmp_path, model, capfd, run):
    path = tmp_path / "x" / "y" / "{name}.glb"
    assert run(model.with_name("none.ply"), "--output", path) == 1
    assert not (tmp_path / "x").exists()
    with file_limit(1000):
        assert run(model, "--output", path) == 1
    assert not (tmp_path / "x").exists()
    assert run(model, "--output", path, "--report", tmp_path / "r" / "r.json") == 0
    assert sorted(content(tmp_path / "x")) == ["y/ring.glb"]
    json.loads((tmp_path / "r" / "r.json").read_text())


def test_a_block_that_writes_nothing_is_an_error(tmp_path):
    with pytest.raises(OSError, match="in part only"), replacing(tmp_path / "a.glb"):
        pass
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(DecompositionError), replacing(tmp_path / "a" / "a.glb"):
        raise DecompositionError("x")
    assert list(tmp_path.iterdir()) == []
