"""Links are followed, and what is no file is not replaced."""

import os
import threading
from pathlib import Path

import pytest
from command import content
from full_disk import full_disk
from weak_convex_decomposition.operators.headless.files.whole import check_whole

FEW = [("output", ".glb"), ("output", ".obj"), ("hulls", ".xml"), ("report", ".json")]


def test_links_are_followed(tmp_path, model, run):
    there = tmp_path / "there"
    there.mkdir()
    for option, ending in FEW:
        for name, old in (("old", True), ("gone", False)):
            goal = there / f"{option}-{name}{ending}"
            link = tmp_path / goal.name
            link.symlink_to(goal)
            if old:
                goal.write_text("earlier")
            assert run(model, f"--{option}", link) == 0, link
            assert link.is_symlink()
            check_whole(goal)
            assert len(goal.read_bytes()) > 100


def test_a_link_to_another_disk_is_followed(tmp_path, model, run):
    disk = tmp_path / "disk"
    disk.mkdir()
    with full_disk(disk):
        for name in ("z.xml", "w.obj", "w.mtl"):
            (disk / name).write_text("mtllib w.mtl\n")
            (tmp_path / name).symlink_to(disk / name)
        (disk / "meshes").mkdir()
        (tmp_path / "z_xml").symlink_to(disk / "meshes")
        assert run(model, "--hulls", tmp_path / "z.xml") == 0
        assert run(model, "--output", tmp_path / "w.obj") == 0
        found = content(disk)
        assert b"<mujoco" in found["z.xml"]
        assert b"newmtl Part" in found["w.mtl"]
        assert sum(name.startswith("meshes/") for name in found) == 4
        assert (tmp_path / "z_xml").is_symlink()


def test_links_in_a_circle(tmp_path, model, capfd, run):
    (tmp_path / "a.glb").symlink_to(tmp_path / "b.glb")
    (tmp_path / "b.glb").symlink_to(tmp_path / "a.glb")
    assert run(model, "--output", tmp_path / "a.glb") == 2
    assert "symbolic links" in capfd.readouterr().err
    assert (tmp_path / "a.glb").is_symlink()


@pytest.mark.parametrize(("option", "ending"), FEW)
def test_a_pipe_is_written_to(tmp_path, model, option, ending, run):
    pipe = tmp_path / f"pipe{ending}"
    os.mkfifo(pipe)
    got = []
    reader = threading.Thread(target=lambda: got.append(pipe.read_bytes()))
    reader.start()
    assert run(model, f"--{option}", pipe) == 0
    reader.join(10)
    assert pipe.is_fifo()
    copy = tmp_path / f"copy{ending}"
    copy.write_bytes(got[0])
    check_whole(copy)
    assert len(got[0]) > 100


def test_a_device_stays_a_device(tmp_path, model, capfd, run):
    link = tmp_path / "full.json"
    link.symlink_to("/dev/full")
    assert run(model, "--report", link) == 1
    assert "(No space left on device)" in capfd.readouterr().err
    assert Path("/dev/full").is_char_device()
