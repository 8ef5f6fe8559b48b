"""Links are followed, and what is no file is not replaced."""

import os
import threading
from pathlib import Path

import bpy
import pytest
from headless.command import content
from headless.full_disk import full_disk
from weak_convex_decomposition.operators.headless.files.whole import check_whole
from weak_convex_decomposition.operators.headless.write.model_files import save

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
        assert found.keys() >= {"meshes/001.obj", "meshes/wcd_manifest.json"}
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


def test_textures_are_found_from_where_the_file_is(tmp_path, suzanne):
    """Paths in a file are relative to its own folder."""
    image = bpy.data.images.new("Paint", 8, 8)
    image.filepath_raw = str(tmp_path / "out" / "textures" / "paint.png")
    image.file_format = "PNG"
    image.save()
    material = bpy.data.materials.new("Paint")
    if not material.node_tree:
        material.use_nodes = True  # Blender 4.2
    nodes = material.node_tree.nodes
    node = nodes.new("ShaderNodeTexImage")
    node.image = image
    shader = next(each for each in nodes if each.type == "BSDF_PRINCIPLED")
    material.node_tree.links.new(node.outputs[0], shader.inputs["Base Color"])
    suzanne.data.materials.append(material)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "in.blend"))
    bpy.ops.file.make_paths_relative()
    save(tmp_path / "out" / "a.obj", None)
    materials = (tmp_path / "out" / "a.mtl").read_text()
    assert "\nmap_Kd textures/paint.png\n" in materials
    save(tmp_path / "out" / "a.blend", None)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out" / "a.blend"))
    assert bpy.data.images["Paint"].filepath == "//textures/paint.png"


def test_another_name_of_an_input(tmp_path, model, capfd, run):
    (tmp_path / "other.ply").hardlink_to(model)
    before = content(tmp_path)
    assert run(model, "--output", tmp_path / "other.ply") == 2
    assert "is an input, too" in capfd.readouterr().err
    assert content(tmp_path) == before


def test_an_input_that_is_a_link_to_itself(tmp_path, model, run, capfd):
    link = tmp_path / "link.ply"
    link.symlink_to(link)
    assert run(link, model, "--output", tmp_path / "{name}.glb") == 1
    assert f"error: {link} does not exist.\n" in capfd.readouterr().err
    assert (tmp_path / f"{model.stem}.glb").exists()


def test_a_folder_that_is_gone_is_a_sentence(tmp_path, model, run, capfd, monkeypatch):
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert run(model, "--report", "r.json") == 2
    assert "error: . cannot be read (No such file or " in capfd.readouterr().err


def test_an_input_that_is_a_pipe_is_refused_at_once(tmp_path, run, capfd):
    os.mkfifo(tmp_path / "a.stl")  # to open it would wait for a writer
    assert run(tmp_path / "a.stl", "--report", tmp_path / "r.json") == 1
    assert "a.stl is a pipe or a device; save" in capfd.readouterr().err
