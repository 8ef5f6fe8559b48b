"""No output takes the place of a file that an input refers to, such as a library."""

import json

import bpy
import pytest
from headless.command import content
from weak_convex_decomposition.operators.headless.read.load import load_file


def saved_textured(path, texture):
    """Save a cube with a texture as .obj, .gltf or .usda, and the texture."""
    image = bpy.data.images.new("Wood", 4, 4)
    image.filepath_raw, image.file_format = str(texture), "PNG"
    image.save()
    bpy.ops.mesh.primitive_cube_add()
    material = bpy.data.materials.new("Wood")
    if bpy.app.version < (5, 0, 0):  # later materials always have nodes
        material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    node = nodes.new("ShaderNodeTexImage")
    node.image = image
    links.new(node.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    bpy.context.active_object.data.materials.append(material)
    if path.suffix == ".obj":
        bpy.ops.wm.obj_export(filepath=str(path), path_mode="RELATIVE")
    elif path.suffix == ".gltf":
        bpy.ops.export_scene.gltf(filepath=str(path), export_format="GLTF_SEPARATE")
    else:
        bpy.ops.wm.usd_export(filepath=str(path))
    return path


def linked(folder):
    """Return a file that links a ring of a library, and the library."""
    library, path = folder / "library.blend", folder / "user.blend"
    bpy.ops.mesh.primitive_torus_add(major_segments=12, minor_segments=6)
    bpy.context.active_object.name = "Ring"
    bpy.ops.wm.save_as_mainfile(filepath=str(library), copy=True)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(str(library), link=True) as (_, wanted):
        wanted.objects = ["Ring"]
    bpy.context.scene.collection.objects.link(bpy.data.objects["Ring"])
    bpy.ops.wm.save_as_mainfile(filepath=str(path), relative_remap=True)
    return path, library


@pytest.mark.parametrize("name", ["library.blend", "LIBRARY.blend"])
def test_a_library_is_not_replaced(tmp_path, run, capfd, name):
    path, _ = linked(tmp_path)
    before = content(tmp_path)
    capfd.readouterr()
    report = tmp_path / "out" / "r.json"
    words = ["--output", tmp_path / name, "--report", report]
    assert run(path, *words) == 1
    sentence = (
        f"{tmp_path / name} is read as well: {path} refers to it; give the output"
        " another name."
    )
    assert capfd.readouterr().err.endswith(f"\nerror: {sentence}\n")
    assert json.loads(report.read_text())["inputs"][0]["errors"] == [sentence]
    report.unlink()
    assert content(tmp_path) == before
    assert run(path, "--output", tmp_path / "parts.blend") == 0


def test_what_one_input_needs_another_one_does_not_replace(tmp_path, model, run, capfd):
    path, library = linked(tmp_path)
    before = content(tmp_path)
    other = model.rename(tmp_path / "in" / "library.ply")
    words = ["--output", f"{tmp_path}/{{name}}.blend"]
    assert run(tmp_path / "user.blend", other, *words) == 2  # over an input
    renamed = path.rename(tmp_path / "in" / "x.blend")
    bpy.ops.wm.open_mainfile(filepath=str(renamed))
    bpy.data.libraries[0].filepath = str(library)
    bpy.ops.wm.save_mainfile()
    capfd.readouterr()
    assert run(renamed, other, *words) == 1
    assert capfd.readouterr().err.count("x.blend refers to it") == 2
    assert library.read_bytes() == before["library.blend"]


@pytest.mark.parametrize(
    ("name", "option", "place"),
    [
        ("a.obj", "report", "a.mtl"),
        ("a.obj", "picture", "wood.png"),
        ("a.gltf", "report", "a.bin"),
        ("a.gltf", "picture", "Wood.png"),
        ("a.usda", "picture", "textures/wood.png"),
    ],
)
def test_neither_are_materials_textures_and_buffers(
    tmp_path, run, capfd, name, option, place
):
    path = saved_textured(tmp_path / name, tmp_path / "wood.png")
    before = content(tmp_path)
    (found,) = [each for each in before if each.lower() == place.lower()]
    capfd.readouterr()
    assert run(path, f"--{option}", tmp_path / found) == 1
    assert f"{found} is read as well: {path} refers" in capfd.readouterr().err
    assert content(tmp_path) == before


def test_layers_of_usd_and_materials_that_another_model_names(tmp_path, run, capfd):
    saved_textured(tmp_path / "part.usda", tmp_path / "wood.png")
    whole = tmp_path / "whole.usda"
    whole.write_text('#usda 1.0\ndef "W" (references = @./part.usda@</root>) {}\n')
    assert tmp_path / "part.usda" in load_file(whole, None, False).refers_to
    first = saved_textured(tmp_path / "a.obj", tmp_path / "wood.png")
    second = tmp_path / "in.obj"
    second.write_bytes(first.read_bytes())  # has the materials of the first
    materials = (tmp_path / "a.mtl").read_bytes()
    assert run(second, "--output", first) == 1
    assert f"a.mtl is read as well: {second} refers to it" in capfd.readouterr().err
    assert (tmp_path / "a.mtl").read_bytes() == materials
