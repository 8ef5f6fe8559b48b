"""USD is read as Blender imports it, with instances, and names that stay the same."""

import json
import struct
from itertools import pairwise

import bpy
import pytest
from headless.instancing import add, box, boxes, rock
from headless.loading import load
from weak_convex_decomposition.operators.headless.read.load import load_file

MESH = """
def Mesh "Rock" {
    int[] faceVertexCounts = [3, 3, 3, 3]
    int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
}
"""
PLACED = """
def Xform "{name}" (
    instanceable = true
    prepend references = </Rocks/Rock>
) {{
    double3 xformOp:translate = ({x}, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""
POINT_INSTANCER = f"""
def PointInstancer "Points" {{
    rel prototypes = [</World/Points/Rock>]
    int[] protoIndices = [0, 0]
    point3f[] positions = [(0, 5, 0), (0, 8, 0)]
    quath[] orientations = [(1, 0, 0, 0), (1, 0, 0, 0)]
    float3[] scales = [(1, 1, 1), (2, 2, 2)]
    def Xform "Rock" {{ {MESH} }}
}}
"""
CLASS = f'class Xform "Rocks" {{\ndef Xform "Rock" {{ {MESH} }}\n}}'


def stage(path, *prims):
    header = '#usda 1.0\n(\nmetersPerUnit = 1\nupAxis = "Z"\n)\n'
    world = f'def Xform "World" {{ {"".join(prims)} }}\n'
    path.write_text(f"{header}{world}{CLASS}\n")
    return path


def test_instanceable_prims_become_objects(tmp_path):
    prims = [PLACED.format(name=name, x=x) for name, x in (("A", 5), ("B", 9))]
    objects = load(stage(tmp_path / "a.usda", *prims))
    assert boxes(objects) == {"A Rock": box(5, 0, 0), "B Rock": box(9, 0, 0)}
    assert objects[0].data == objects[1].data


def test_meshes_and_holes_that_blender_does_not_heed_are_named(tmp_path):
    settings = {
        "A": "int[] holeIndices = [1]",
        "B": 'uniform token purpose = "guide"',
        "C": 'token visibility = "invisible"',
        "D": 'uniform token purpose = "render"',
    }
    prims = [
        MESH.replace("Rock", name).replace("{", f"{{\n{setting}", 1)
        for name, setting in settings.items()
    ]
    loaded = load_file(stage(tmp_path / "a.usda", *prims), None, with_modifiers=False)
    assert [obj.name for obj in loaded.objects] == ["A", "D"]
    left_out, holed = loaded.about
    assert left_out.endswith("were left out: B, C.")
    assert holed.startswith("Faces that USD marks as holes were read as others")
    assert holed.endswith(": A.")
    assert not load_file(stage(tmp_path / "a.usda", MESH), None, False).about


@pytest.mark.parametrize(
    ("types", "others"),
    [
        ("point3f[]", "points[]"),
        ("point3f[]", "double3[]"),
        ("int[] faceVertexCounts", "float[] faceVertexCounts"),
        ("int[] faceVertexIndices", "int64[] faceVertexIndices"),
    ],
)
def test_arrays_of_other_types_are_none(tmp_path, unexpected, types, others):
    text = stage(tmp_path / "a.usda", MESH).read_text().replace(types, others)
    sentence = "a mesh, Rock, with faces that refer to missing points"
    assert unexpected({"a.usda": (text.encode(), sentence)}) == {}


def test_point_instancers_become_objects(tmp_path):
    found = boxes(load(stage(tmp_path / "a.usda", POINT_INSTANCER)))
    names = ["Points Rock 1", "Points Rock 2"]
    assert found == dict(zip(names, [box(0, 5, 0), box(0, 8, 0, 2)], strict=True))


def test_prims_of_one_name_are_numbered_by_place(tmp_path):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    mesh = rock()
    for number in (2, 0, 3, 1):
        add(f"At{number}", mesh, (3 * number, 0, 0))
    path = tmp_path / "a.usdc"
    bpy.ops.wm.usd_export(filepath=str(path))
    names = ["Rock", "Rock.001", "Rock.002", "Rock.003"]
    expected = {name: box(3 * x, 0, 0) for x, name in enumerate(names)}
    assert boxes(load(path)) == expected
    assert [mesh.name for mesh in bpy.data.meshes] == names


def test_coordinates_that_are_not_numbers_have_an_error_each(tmp_path):
    path = stage(tmp_path / "a.usda", MESH.replace("(1, 0, 0)", "(nan, 0, 0)"))
    (obj,) = load(path)
    bpy.context.view_layer.objects.active = obj
    with pytest.raises(RuntimeError, match="not finite"):
        bpy.ops.wcd.decompose()


@pytest.mark.parametrize("start", [0, 101])
def test_animated_prims_are_where_their_stage_begins(tmp_path, start):
    samples = f"timeSamples = {{{start}: (0, 0, 0), {start + 24}: (24, 0, 0)}}"
    prim = PLACED.format(name="A", x=0).replace(
        "translate = (0, 0, 0)", f"translate.{samples}"
    )
    path = stage(tmp_path / "a.usda", prim)
    text = path.read_text()
    path.write_text(text.replace("upAxis", f"startTimeCode = {start}\nupAxis"))
    assert boxes(load(path)) == {"A Rock": box(0, 0, 0)}


def test_faces_that_blender_crashes_on(tmp_path, unexpected):
    changes = [
        ("3, 2]", "3, 4]"),
        ("3, 2]", "3, -1]"),
        ("[3, 3, 3, 3]", "[3, 3, 3]"),
        ("[3, 3, 3, 3]", "[3, 3, 3, 3, 3, 3, 3]"),
        ("[3, 3, 3, 3]", "[3, 3, 3, -3, 3, 3]"),
        ("points = ", "normals = "),
    ]
    for place in (POINT_INSTANCER, MESH, PLACED.format(name="A", x=5)):
        for change in changes:
            text = stage(tmp_path / "a.usda", place).read_text().replace(*change)
            case = text.encode(), "a mesh, Rock, with faces that refer to missing"
            assert unexpected({"a.usda": case}) == {}, change
    text = MESH.replace("[3, 3, 3, 3]", "[3, 3, 3, 1, 2]")
    (obj,) = load(stage(tmp_path / "a.usda", text))
    assert len(obj.data.polygons) == 3


@pytest.mark.parametrize("share", [0.9, 0.98])
def test_an_archive_without_its_end_is_truncated(tmp_path, unexpected, share):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    add("Rock", rock())
    path = tmp_path / "a.usdz"
    bpy.ops.wm.usd_export(filepath=str(path))
    data = path.read_bytes()
    cases = {"a.usdz": (data[: int(len(data) * share)], "truncated")}
    assert unexpected(cases) == {}


def test_instances_of_gltf_become_objects(tmp_path):
    """EXT_mesh_gpu_instancing, by hand: Blender does not export it."""
    corners = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)
    faces = struct.pack("<12H", 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2)
    places = struct.pack("<6f", 0, 0, 0, 5, 0, 0)
    (tmp_path / "a.bin").write_bytes(corners + faces + places)
    ends = [0, len(corners), len(corners + faces), len(corners + faces + places)]
    views = [
        {"buffer": 0, "byteOffset": start, "byteLength": end - start}
        for start, end in pairwise(ends)
    ]
    kinds = [(5126, 4, "VEC3"), (5123, 12, "SCALAR"), (5126, 2, "VEC3")]
    accessors = [
        {"bufferView": number, "componentType": code, "count": count, "type": kind}
        for number, (code, count, kind) in enumerate(kinds)
    ]
    accessors[0] |= {"min": [0, 0, 0], "max": [1, 1, 1]}
    instancing = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}
    primitive = {"attributes": {"POSITION": 0}, "indices": 1}
    scene = {
        "asset": {"version": "2.0"},
        "extensionsUsed": list(instancing),
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "Rock", "mesh": 0, "extensions": instancing}],
        "meshes": [{"name": "Rock", "primitives": [primitive]}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": ends[-1], "uri": "a.bin"}],
    }
    (tmp_path / "a.gltf").write_text(json.dumps(scene))
    found = boxes(load(tmp_path / "a.gltf"))
    assert [corner[0] for corner in found.values()] == [0, 5]
