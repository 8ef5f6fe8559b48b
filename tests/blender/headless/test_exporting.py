import errno
from itertools import pairwise

import bpy
import numpy as np
import pytest
from edited import record_of
from hand_made import bands, decomposition_of
from headless.loading import load
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.operators.bridge.parts.write import write_parts
from weak_convex_decomposition.operators.headless.files.replacing import explaining
from weak_convex_decomposition.operators.headless.formats import (
    MODEL_ENDINGS,
    READ_ENDINGS,
)
from weak_convex_decomposition.operators.headless.write.model_files import save

OFF = """OFF
8 6 0
0 0 0
3 0 0
3 2 0
0 2 0
0 0 1
3 0 1
3 2 1
0 2 1
4 0 3 2 1
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""


def coordinates(path):
    """Return the coordinates in a file as they stand there."""
    (obj,) = load(path, "Z")
    assert obj.matrix_world.is_identity
    return sorted({tuple(round(x, 4) for x in v.co) for v in obj.data.vertices})


@pytest.fixture
def parted(suzanne):
    labels = bands(suzanne, 4)
    write_parts(suzanne, decomposition_of(labels), Parameters(seed=3))
    return suzanne, labels


@pytest.mark.parametrize("up", ["Y", "Z"])
@pytest.mark.parametrize("written", [".obj", ".ply"])
@pytest.mark.parametrize("read", [".off", ".obj", ".ply"])
def test_coordinates_line_up_with_the_input(tmp_path, read, written, up):
    path = tmp_path / "block.off"
    path.write_text(OFF)
    if read != ".off":
        load(path, "Z")
        path = path.with_suffix(read)
        save(path, "Z")
    before = coordinates(path)
    load(path, up)
    save(tmp_path / f"out{written}", up)
    assert coordinates(tmp_path / f"out{written}") == before


def test_ply_has_sharp_colors(tmp_path, parted):
    parts, labels = parted
    wanted = [row.color[:3] for row in parts.wcd_parts]
    save(tmp_path / "a.ply", None)
    (obj,) = load(tmp_path / "a.ply")
    mesh = obj.data
    assert len(mesh.polygons) == len(labels)
    colors = mesh.color_attributes[0].data
    numbers = mesh.attributes["part"].data
    for polygon, label in zip(mesh.polygons, labels, strict=True):
        for vertex in polygon.vertices:
            assert numbers[vertex].value == label
            assert colors[vertex].color[:3] == pytest.approx(wanted[label], abs=0.01)


def test_ply_doubles_only_vertices_on_seams(tmp_path, parted):
    obj, labels = parted
    obj.data.uv_layers.remove(obj.data.uv_layers[0])  # has seams of its own
    before = np.array([v.co for v in obj.data.vertices])
    pairs = {
        (v, k)
        for p, k in zip(obj.data.polygons, labels, strict=True)
        for v in p.vertices
    }
    save(tmp_path / "a.ply", None)
    (copy,) = load(tmp_path / "a.ply")
    after = np.array([v.co for v in copy.data.vertices])
    assert len(after) == len(pairs) > len(before)
    assert np.allclose(after[: len(before)], before, atol=1e-6)


def test_ply_leaves_nothing_behind(tmp_path, parted):
    before = {block.name for block in (*bpy.data.objects, *bpy.data.meshes)}
    save(tmp_path / "a.ply", None)
    assert {block.name for block in (*bpy.data.objects, *bpy.data.meshes)} == before


def test_ply_of_a_mesh_without_parts(tmp_path, suzanne):
    save(tmp_path / "a.ply", None)
    (obj,) = load(tmp_path / "a.ply")
    assert {d.value for d in obj.data.attributes["part"].data} == {-1}


@pytest.mark.parametrize("domain", ["FACE", "POINT"])
def test_an_attribute_of_the_user_is_not_parts(tmp_path, suzanne, domain):
    if domain == "POINT":
        suzanne.data = bpy.data.meshes.new("points")
        suzanne.data.from_pydata(np.eye(30, 3), [], [])
    mine = suzanne.data.attributes.new("wcd_part", "INT", domain)
    mine.data.foreach_set("value", np.arange(len(mine.data)))
    save(tmp_path / "a.ply", None)
    (obj,) = load(tmp_path / "a.ply")
    assert {d.value for d in obj.data.attributes["part"].data} == {-1}


def test_obj_has_materials_and_groups(tmp_path, parted):
    _, labels = parted
    save(tmp_path / "a.obj", None)
    text = (tmp_path / "a.obj").read_text()
    assert "mtllib a.mtl\n" in text
    materials = (tmp_path / "a.mtl").read_text()
    counts = {}
    for name, line in pairwise(_faces_by_material(text)):
        counts[name] = line
    for part, count in enumerate(np.bincount(labels)):
        name = f"Part_0{part + 1}"
        assert f"newmtl {name}\n" in materials
        assert f"_{name}\n" in text
        assert counts[name] == count


def _faces_by_material(text):
    """Yield material, number of faces, material, number of faces, …"""
    for block in text.split("usemtl ")[1:]:
        name, *rest = block.splitlines()
        yield name
        yield sum(line.startswith("f ") for line in rest)


def test_glb_keeps_materials_and_record(tmp_path, parted):
    _, labels = parted
    save(tmp_path / "a.glb", None)
    (obj,) = load(tmp_path / "a.glb")
    names = [obj.material_slots[p.material_index].name for p in obj.data.polygons]
    counts = [names.count(f"Part 0{part + 1}") for part in range(4)]
    sizes = [len(p.vertices) - 2 for p in parted_polygons()]
    assert counts == np.bincount(labels, sizes).astype(int).tolist()
    assert record_of(obj)["seed"] == 3


def parted_polygons():
    bpy.ops.mesh.primitive_monkey_add()
    return bpy.context.active_object.data.polygons


def test_blend_keeps_everything(tmp_path, parted):
    _, labels = parted
    save(tmp_path / "a.blend", None)
    (obj,) = load(tmp_path / "a.blend")
    values = [d.value for d in obj.data.attributes["wcd_part"].data]
    assert values == labels.tolist()
    assert [g.name for g in obj.vertex_groups] == [f"Part 0{k}" for k in (1, 2, 3, 4)]
    assert record_of(obj)["k"] == 4


@pytest.mark.parametrize("ending", [e for e in MODEL_ENDINGS if e in READ_ENDINGS])
def test_written_files_can_be_decomposed_again(tmp_path, parted, ending):
    save(tmp_path / f"a{ending}", None)
    (obj,) = load(tmp_path / f"a{ending}")
    labels = bands(obj, 3)
    write_parts(obj, decomposition_of(labels), Parameters())
    # A .blend file knows its parts, which those of the new run continue.
    assert len({group.name for group in obj.vertex_groups}) == 3
    assert sum(s.name.startswith("Part ") for s in obj.material_slots) >= 3


def test_nothing_else_is_left_in_the_folder(tmp_path, parted):
    for ending in MODEL_ENDINGS:
        folder = tmp_path / ending
        folder.mkdir()
        (folder / f"a{ending}").write_text("earlier")
        save(folder / f"a{ending}", None)
        names = {file.name for file in folder.iterdir()}
        assert names == {f"a{ending}"} | ({"a.mtl"} if ending == ".obj" else set())
        assert (folder / f"a{ending}").read_bytes() != b"earlier", ending


def test_links_stay_and_what_they_point_to_is_replaced(tmp_path, parted):
    there = tmp_path / "there"
    there.mkdir()
    for ending in (*MODEL_ENDINGS, ".mtl"):
        (there / f"b{ending}").write_text("earlier")
        (tmp_path / f"a{ending}").symlink_to(there / f"b{ending}")
    (there / "b.obj").write_text("mtllib a.mtl\n")
    for ending in MODEL_ENDINGS:
        save(tmp_path / f"a{ending}", None)
    for ending in (*MODEL_ENDINGS, ".mtl"):
        assert (tmp_path / f"a{ending}").is_symlink(), ending
        assert (there / f"b{ending}").read_bytes() != b"earlier", ending
    assert len(list(there.iterdir())) == len(MODEL_ENDINGS) + 1


def test_errors_name_the_file_that_was_asked_for(tmp_path):
    path = tmp_path / "a.glb"
    error = PermissionError(errno.EACCES, "Permission denied", ".wcd-1.glb")
    with pytest.raises(DecompositionError) as caught, explaining(path, "written"):
        raise error
    assert str(caught.value) == f"{path} cannot be written (Permission denied)."


def test_a_folder_that_cannot_be_made(tmp_path, parted):
    (tmp_path / "file").write_text("text")
    for ending in MODEL_ENDINGS:
        path = tmp_path / "file" / f"a{ending}"
        with pytest.raises(DecompositionError, match=rf"a\{ending} cannot be written"):
            save(path, None)


def test_a_ply_file_of_a_mesh_that_is_empty(tmp_path, parted):
    empty = bpy.data.objects.new("Empty", bpy.data.meshes.new("Empty"))
    bpy.context.collection.objects.link(empty)
    save(tmp_path / "a.ply", None)
    (obj,) = load(tmp_path / "a.ply")
    assert len(obj.data.polygons) == 500
